# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Snakemake's messages as lines of the fleet: progress and troubles. All its words go into
OUT/snakemake.txt, so these take the stderr that tools/fleet.sh has, whose number is FLEET_STDERR.
"""
import os
import sys
import time

SECONDS_BETWEEN = 2.0
LAST = {"told_s": 0.0}


def say(text):
    number = int(os.environ.get("FLEET_STDERR", sys.stderr.fileno()))
    os.write(number, f"fleet: {text}\n".encode())


def say_progress(done, total):
    now = time.monotonic()
    if done == total or now - LAST["told_s"] > SECONDS_BETWEEN:
        LAST["told_s"] = now
        say(f"{done} of {total} jobs")


def log_handler(msg):
    level, text = msg["level"], str(msg.get("msg") or "")
    if level == "progress":
        say_progress(msg["done"], msg["total"])
    elif level == "job_error":
        say(f"a job of rule {msg['name']} failed: {', '.join(map(str, msg['output']))}")
    elif level == "error":
        say(text)
    elif level == "info" and text.startswith("Nothing to be done"):
        say("nothing to do, since all results are up to date")
