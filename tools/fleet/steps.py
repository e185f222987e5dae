# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Helps the steps of the workflow. A step works in a folder of its own and puts it in place at its
end by one rename, so that a step which is killed leaves nothing behind that looks like a result."""
import contextlib
import ctypes
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time

PR_SET_PDEATHSIG = 1
# Results of a program, which are rows of the table; other codes are troubles of the machine.
DONE, UNTRUSTED, CONFIGURATION, INPUT = 0, 6, 3, 5
FINAL = (DONE, UNTRUSTED, CONFIGURATION, INPUT)
MAX_SAID = 300


def die_with_parent():
    """Makes the kernel kill this process when its parent dies, even by kill -9."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() == 1:  # the parent has died already
        os._exit(1)


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def write_json(path, content):
    pathlib.Path(path).write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


@contextlib.contextmanager
def replaced(folder):
    """A fresh folder that takes the place of FOLDER when the with statement ends well."""
    work = pathlib.Path("scratch") / (str(folder).replace("/", "_") +
                                      f"@{socket.gethostname()}@{os.getpid()}")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    try:
        yield work
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        os.rename(work, folder)
    finally:
        shutil.rmtree(work, ignore_errors=True)


def call(words, log):
    """Runs a program with its words in a file; returns the exit code, the CPU time, the time by the
    clock [s], and its last words on stderr."""
    words = [str(word) for word in words]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with open(log, "ab") as stream:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=stream,
                              stderr=subprocess.PIPE, check=False, preexec_fn=die_with_parent)
        stream.write(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = done.stderr.decode(errors="replace").strip().splitlines()
    return {"exit": done.returncode, "wall_s": time.monotonic() - start,
            "cpu_s": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "said": said[-1][:MAX_SAID] if said else "", "program": os.path.basename(words[0])}


def stop_unless_final(done, log):
    """Ends the step where a later attempt may go better: a signal, a full disk, no memory."""
    if done["exit"] not in FINAL:
        print(f"{done['program']} ended with {done['exit']}: {done['said']}\n{log} has its words; "
              "mend the cause and run the fleet again", file=sys.stderr)
        sys.exit(1)
