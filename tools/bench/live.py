# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Runs liod on a log that lcm-logplayer plays over UDP multicast, in a network namespace of its own,
for the other scripts of this folder. Needs tools/setup.sh."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("LIO_BUILD", ROOT / "build")) / "bin"
URL = "udpm://239.255.76.67:7667?ttl=0"
START_TIMEOUT_S = 30
IDLE_S = 1.5       # without processor time liod has done all its work
MAX_DRAIN_S = 120


def enter_namespace():
    """Starts this script again where no other LCM program is heard, as far as that is allowed."""
    if os.environ.get("LIO_IN_NAMESPACE") == "yes":
        subprocess.run(["ip", "link", "set", "lo", "up", "multicast", "on"], check=True)
        subprocess.run(["ip", "route", "add", "224.0.0.0/4", "dev", "lo"], check=True)
        return
    for flags in (["-n"] if os.geteuid() == 0 else []) + ["-rn"]:
        if subprocess.run(["unshare", flags, "true"], check=False,
                          stderr=subprocess.DEVNULL).returncode == 0:
            os.environ["LIO_IN_NAMESPACE"] = "yes"
            os.environ.setdefault("LCM_DEFAULT_URL", URL)
            words = [sys.executable, "-B", *sys.argv]
            os.execvp("unshare", ["unshare", flags, *words])
    sys.exit(f"{sys.argv[0]}: a network namespace of its own is needed and not allowed here")


class Liod:
    """A running liod; `out` also gets its stderr as liod.log. `prefix` is a command that becomes
    liod, such as chrt with its words."""

    def __init__(self, out, *words, prefix=()):
        self.out = pathlib.Path(out)
        self.out.mkdir(parents=True, exist_ok=True)
        self.log_path = self.out / "liod.log"
        command = [*prefix, BIN / "liod", "--out", out, "--overwrite", *words]
        with open(self.log_path, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen([str(word) for word in command], stderr=log,
                                            stdin=subprocess.DEVNULL)
        deadline = time.monotonic() + START_TIMEOUT_S
        while "listening" not in self.log_path.read_text(encoding="utf-8"):
            if self.process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError(f"liod did not start: {self.log_path.read_text()}")
            time.sleep(0.05)

    @property
    def pid(self):
        return self.process.pid

    def rss_mb(self):
        for line in pathlib.Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) * 1024e-6
        return 0.0

    def cpu_s(self):
        fields = pathlib.Path(f"/proc/{self.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def wait_until_idle(self):
        """Returns when liod has nearly used no processor time for a while."""
        deadline = time.monotonic() + MAX_DRAIN_S
        while time.monotonic() < deadline and self.process.poll() is None:
            before = self.cpu_s()
            time.sleep(IDLE_S)
            if self.process.poll() is None and self.cpu_s() - before < 0.02 * IDLE_S:
                return

    def stop(self):
        """Returns the exit code."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(timeout=60)

    def stats(self):
        return json.loads((self.out / "stats.json").read_text(encoding="utf-8"))


def start_player(log, speed):
    return subprocess.Popen(["lcm-logplayer", f"--speed={speed}", str(log)],
                            stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)


def play(log, speed):
    if start_player(log, speed).wait() != 0:
        raise RuntimeError(f"lcm-logplayer could not play {log}")


def losses(stats):
    """Messages and scans that were lost because something was too slow."""
    names = ("num_imu_missing", "num_imu_queue_dropped", "num_chunks_queue_dropped",
             "num_chunks_missing", "num_scans_dropped")
    return sum(stats[name] for name in names) + max(0, stats["num_kernel_dropped"])
