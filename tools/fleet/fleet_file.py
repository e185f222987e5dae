# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The fleet file: which drives, configurations and peers there are. All faults are told at once."""
import dataclasses
import difflib
import fnmatch
import functools
import pathlib
import re
import shlex

from located import Entry, Faults, read_tsv, read_yaml

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._+-]*")
SEEDS = re.compile(r"\d+(\.\.\d+)?(\s*,\s*\d+(\.\.\d+)?)*")
TOP = ("drives", "configurations", "peers", "baseline", "keep")
DRIVE = ("name", "input", "sim", "seeds", "truth", "rig", "words", "group", "keep", "scans", "once")
CONFIGURATION = ("name", "config", "set", "threads", "build", "words", "program", "drives")
PEER = ("name", "files", "words")
KEEP = ("logs", "maps")
PROGRAMS = ("lio-run", "lio-replay")
# Words of lio-sim that are the fleet's own, and what to do instead.
OWN_WORDS = {"--seed": "name the seeds in seeds", "--scans": "name the drive in scans",
             "--out": "leave it out", "--picture": "leave it out", "--list": "leave it out"}
MAX_RUNS = 100_000


@dataclasses.dataclass(frozen=True)
class Drive:
    """One drive: a simulated one has the words of lio-sim, a recorded one its input."""
    name: str
    group: str
    sim: tuple = ()
    seed: int | None = None
    scans: str = ""  # the drive whose scans are taken
    input: str = ""
    truth: str = ""
    rig: str = ""
    words: tuple = ()
    keep: tuple = ()
    once: bool = False  # other programs do not make it anew
    place: str = ""


@dataclasses.dataclass(frozen=True)
class Configuration:
    name: str
    config: tuple = ()
    set: tuple = ()
    threads: int = 1
    build: str = ""
    words: tuple = ()
    program: str = PROGRAMS[0]
    drives: frozenset | None = None  # names of those alone that it runs on
    place: str = ""

    def runs_on(self, drive):
        return self.drives is None or drive.name in self.drives


@dataclasses.dataclass(frozen=True)
class Peer:
    name: str
    files: dict  # drive's name to TUM file
    words: tuple = ()

    def runs_on(self, _):
        return True


@dataclasses.dataclass
class Fleet:
    drives: list
    configurations: list
    peers: list
    baseline: str
    keep: tuple

    @functools.cached_property
    def by_name(self):
        return {drive.name: drive for drive in self.drives}

    def keeps_log(self, drive):
        return "logs" in (*self.keep, *drive.keep)


class Reader:
    def __init__(self, file):
        self.file, self.faults = pathlib.Path(file), Faults()

    def near(self, entry, text):
        """A path of the fleet file is relative to the file that names it."""
        return str((entry.file.parent / text).resolve())

    def check_keys(self, entry, known):
        for key in entry.values:
            if key not in known:
                nearest = difflib.get_close_matches(key, known, 1)
                hint = f"did you mean {nearest[0]}?" if nearest else f"known are {', '.join(known)}"
                self.faults.add(entry.place(key), f"{key}: unknown key; {hint}")

    def text(self, entry, key):
        value = entry.values.get(key, "")
        if isinstance(value, str):
            return value
        self.faults.add(entry.place(key), f"{key}: needs one value, not a list or mapping")
        return ""

    def words(self, entry, key):
        """A list of YAML, or text that is split as a shell does."""
        value = entry.values.get(key, "")
        if isinstance(value, list) and all(isinstance(item, str) for item in value):
            return tuple(value)
        try:
            return tuple(shlex.split(self.text(entry, key)))
        except ValueError as error:
            self.faults.add(entry.place(key), f"{key}: {error}; close the quotes")
            return ()

    def path(self, entry, key):
        text = self.text(entry, key)
        if not text:
            return ""
        path = self.near(entry, text)
        if not pathlib.Path(path).exists():
            self.faults.add(entry.place(key), f"{key}: {text} is not there; "
                            f"paths are relative to {entry.file.parent}")
        return path

    def name(self, entry, names):
        """Returns the entry's name, which is a folder's name too, or an empty text with a fault."""
        name = self.text(entry, "name")
        if not NAME.fullmatch(name):
            self.faults.add(entry.place("name"), f"name: {name or 'is missing'}; give letters, "
                            "digits and . _ + -, beginning with a letter or digit")
            return ""
        if name in names:
            self.faults.add(entry.place("name"), f"name: {name} is taken by {names[name]}; "
                            "choose another")
            return ""
        names[name] = entry.place("name")
        return name

    def seeds(self, entry):
        value = entry.values.get("seeds", "")
        text = ",".join(value) if isinstance(value, list) else self.text(entry, "seeds") or "1"
        if not SEEDS.fullmatch(text):
            self.faults.add(entry.place("seeds"), f"seeds: {text}; give them as 1..20 or 1,2,7")
            return []
        seeds = []
        for part in text.split(","):
            first, _, last = part.strip().partition("..")
            seeds += range(int(first), min(int(last or first), int(first) + MAX_RUNS) + 1)
        if len(set(seeds)) != len(seeds) or not seeds:
            self.faults.add(entry.place("seeds"), f"seeds: {text} names none, or one twice")
        return seeds

    def word_of_sim(self, entry, word):
        """A word that names a file, such as a sensor's, names it from wherever a job runs."""
        path = self.near(entry, word)
        return path if pathlib.Path(path).is_file() else word

    def drives_of(self, entry, names):
        self.check_keys(entry, DRIVE)
        name = self.name(entry, names)
        if ("sim" in entry.values) == ("input" in entry.values):
            self.faults.add(entry.place(), f"drive {name}: give either input, a recording, or sim, "
                            "the words of lio-sim")
            return []
        group = self.text(entry, "group") or name
        truth, rig = self.path(entry, "truth"), self.path(entry, "rig")
        more = {"words": self.words(entry, "words"), "keep": self.keep(entry, KEEP[:1]),
                "once": self.one_of(entry, "once", ("no", "yes")) == "yes"}
        if "input" in entry.values:
            for key in {"seeds", "scans"} & entry.values.keys():
                self.faults.add(entry.place(key), f"{key}: only a drive with sim has {key}")
            return [Drive(name, group, input=self.path(entry, "input"), truth=truth, rig=rig,
                          place=entry.place(), **more)]
        sim = tuple(self.word_of_sim(entry, word) for word in self.words(entry, "sim"))
        for word, fix in OWN_WORDS.items():
            if any(given.split("=")[0] == word for given in sim):
                self.faults.add(entry.place("sim"), f"sim: {word} is the fleet's own; {fix}")
        if not any(given.split("=")[0] == "--scenario" for given in sim):
            self.faults.add(entry.place("sim"), "sim: needs --scenario NAME; see lio-sim --help")
        seeds, scans = self.seeds(entry), self.text(entry, "scans")
        return [Drive(f"{name}-{seed}", group, sim=sim, seed=seed, truth=truth, rig=rig,
                      scans=f"{scans}-{seed}" if scans else "", place=entry.place("sim"), **more)
                for seed in seeds]

    def one_of(self, entry, key, known):
        value = self.text(entry, key) or known[0]
        if value not in known:
            self.faults.add(entry.place(key), f"{key}: {value}; known are {', '.join(known)}")
        return value

    def named_drives(self, entry, drives):
        """The names of the drives that an entry's patterns match, or None where it has no such."""
        patterns = self.words(entry, "drives")
        found = {pattern: fnmatch.filter((drive.name for drive in drives), pattern)
                 for pattern in patterns}
        for pattern, matched in found.items():
            if not matched:
                self.faults.add(entry.place("drives"), f"drives: {pattern} matches no drive's "
                                "name; a simulated one is called NAME-SEED")
        return frozenset().union(*found.values()) if patterns else None

    def configuration(self, entry, names, drives):
        self.check_keys(entry, CONFIGURATION)
        name = self.name(entry, names)
        files = []
        for text in self.words(entry, "config"):
            files.append(self.near(entry, text))
            if not pathlib.Path(files[-1]).is_file():
                self.faults.add(entry.place("config"), f"config: {text} is not there; "
                                f"paths are relative to {entry.file.parent}")
        settings = self.words(entry, "set")
        for setting in settings:
            if "=" not in setting:
                self.faults.add(entry.place("set"), f"set: {setting} is not KEY=VALUE")
        threads = self.text(entry, "threads") or "1"
        if not threads.isdigit() or not 1 <= int(threads) <= 64:
            self.faults.add(entry.place("threads"), f"threads: {threads} is not within 1 .. 64")
            threads = "1"
        return Configuration(name, tuple(files), settings, int(threads), self.path(entry, "build"),
                             self.words(entry, "words"), self.one_of(entry, "program", PROGRAMS),
                             self.named_drives(entry, drives), entry.place())

    def peer(self, entry, names, drives):
        self.check_keys(entry, PEER)
        name, pattern = self.name(entry, names), self.text(entry, "files")
        if "{drive}" not in pattern and len(drives) > 1:
            self.faults.add(entry.place("files"), "files: needs {drive} in place of the drive's "
                            "name, such as kiss/{drive}.tum")
            return Peer(name, {})
        paths = {drive.name: self.near(entry, pattern.replace("{drive}", drive.name))
                 for drive in drives}
        files = {drive: path for drive, path in paths.items() if pathlib.Path(path).is_file()}
        if not files and paths:
            first = next(iter(paths.values()))
            self.faults.add(entry.place("files"), f"files: no drive has one; the first would be "
                            f"{first}")
        return Peer(name, files, self.words(entry, "words"))

    def entries(self, top, key):
        """The entries below a key of the fleet file: a list, or the name of a TSV file."""
        value = top.values.get(key, [])
        if isinstance(value, str) and value:
            file = pathlib.Path(self.path(top, key))
            return read_tsv(file, self.faults) if file.is_file() else []
        if isinstance(value, list) and all(isinstance(item, Entry) for item in value):
            return value
        self.faults.add(top.place(key), f"{key}: needs a list of entries, or a TSV file's name")
        return []

    def top(self):
        if self.file.suffix == ".tsv":
            drives = read_tsv(self.file, self.faults)
            return Entry(self.file, 1, {"drives": drives}, {})
        return read_yaml(self.file, self.faults) or Entry(self.file, 1, {}, {})

    def keep(self, entry, known):
        kept = self.words(entry, "keep")
        for word in kept:
            if word not in known:
                self.faults.add(entry.place("keep"), f"keep: {word}; known: {', '.join(known)}")
        return kept

    def check_expanded(self, top, drives):
        seen = set()
        for drive in drives:
            if drive.name in seen:
                self.faults.add(top.place("drives"), f"two drives get the name {drive.name}, since "
                                "a seed is put behind a name; rename one")
            seen.add(drive.name)

    def check_scans(self, drives):
        whole = {drive.name for drive in drives if drive.sim and not drive.scans}
        for drive in drives:
            if drive.scans and drive.scans not in whole:
                self.faults.add(drive.place, f"scans: {drive.scans} is no simulated drive with "
                                "scans of its own; name one that has the same seeds")

    def fleet(self):
        top = self.top()
        self.check_keys(top, TOP)
        names, systems = {}, {}
        drives = [drive for entry in self.entries(top, "drives")
                  for drive in self.drives_of(entry, names)]
        self.check_expanded(top, drives)
        self.check_scans(drives)
        configurations = [self.configuration(entry, systems, drives)
                          for entry in self.entries(top, "configurations")]
        peers = [self.peer(entry, systems, drives) for entry in self.entries(top, "peers")]
        if not configurations and "configurations" not in top.values:
            configurations = [Configuration("default", place=top.place())]
            systems["default"] = top.place()
        if not drives and not self.faults:
            self.faults.add(top.place("drives"), "drives: there are none; name at least one")
        baseline = self.text(top, "baseline") or next(iter(systems), "")
        if baseline and baseline not in systems:
            self.faults.add(top.place("baseline"), f"baseline: {baseline} is neither a "
                            f"configuration nor a peer; known are {', '.join(systems)}")
        return Fleet(drives, configurations, peers, baseline, self.keep(top, KEEP))


def read_fleet(file):
    """Returns the fleet and the list of all faults; the fleet holds only if there is none."""
    reader = Reader(file)
    try:
        fleet = reader.fleet()
    except (OSError, UnicodeDecodeError) as error:
        reader.faults.add(reader.file, f"cannot be read: {getattr(error, 'strerror', error)}")
        fleet = None
    return fleet, list(reader.faults)
