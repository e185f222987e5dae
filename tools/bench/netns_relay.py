#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The bad link of netns.sh: takes LCM's datagrams from the host's own loopback and sends them over
the cable, of which it loses and delays some. Many kernels have no netem for that.

    netns_relay.py CASE MTU CABLE_ADDRESS
"""
import heapq
import itertools
import random
import select
import socket
import struct
import sys
import time

GROUP, PORT = "239.255.76.67", 7667
LOSS_OF_PACKETS = 0.02
LATE_SHARE, LATE_S = 0.25, 0.002
HEADER_BYTES = 28  # IP and UDP


def open_input():
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 23)
    sock.bind((GROUP, PORT))
    sock.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                    struct.pack("4s4s", socket.inet_aton(GROUP), socket.inet_aton("127.0.0.1")))
    return sock


def open_output(address):
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(address))
    sock.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 1)
    sock.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 0)
    return sock


def is_lost(case, size, mtu):
    if case != "loss":
        return False
    packets = -(-(size + HEADER_BYTES) // mtu)
    return random.random() > (1.0 - LOSS_OF_PACKETS) ** packets


def main():
    case, mtu, address = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    random.seed(1)
    source, sink = open_input(), open_output(address)
    waiting, number = [], itertools.count()
    print("relay: listening", flush=True)
    while True:
        timeout = max(0.0, waiting[0][0] - time.monotonic()) if waiting else None
        if select.select([source], [], [], timeout)[0]:
            data = source.recv(1 << 16)
            if not is_lost(case, len(data), mtu):
                late = LATE_S if case == "reorder" and random.random() < LATE_SHARE else 0.0
                heapq.heappush(waiting, (time.monotonic() + late, next(number), data))
        while waiting and waiting[0][0] <= time.monotonic():
            sink.sendto(heapq.heappop(waiting)[2], (GROUP, PORT))


if __name__ == "__main__":
    main()
