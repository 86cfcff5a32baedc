"""Attacks a server of this machine and prints what came of it, as a table and as JSON.

usage: attack.py --server PROGRAM --stubs FOLDER [--seconds S] [--only WORD] [--json FILE]
                 [--proxy FILE]

FOLDER holds what protoc makes of proto/ for Python. With the configuration of a HAProxy, the attacks
below the calls are made through it, too. The exit code is 1 if a bar is not met.
"""
import argparse
import dataclasses
import json
import os
import sys

os.environ.setdefault("GRPC_VERBOSITY", "NONE")  # what fails is counted

import calls
import proxy
from attacks import Attacks


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--server", required=True, help="the program clearway-server")
    parser.add_argument("--stubs", required=True, help="folder of Python modules made from proto/")
    parser.add_argument("--seconds", type=float, default=30, help="how long each attack goes on")
    parser.add_argument("--only", default="", help="attacks whose name holds this word")
    parser.add_argument("--proxy", help="configuration of a HAProxy to attack through")
    parser.add_argument("--json", help="file to write the rows to")
    arguments = parser.parse_args()
    attacks = Attacks(arguments.server, calls.Stubs(arguments.stubs), arguments.seconds,
                      arguments.proxy if proxy.PROGRAM else None)
    rows = []
    for name in [n for n in dir(attacks) if n.startswith("attack_") and arguments.only in n]:
        for row in getattr(attacks, name)():
            rows.append(row)
            print(f"| {row.attack} | {row.seen} | {'met' if row.met else 'NOT MET'} |", flush=True)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as out:
            json.dump([dataclasses.asdict(row) for row in rows], out, indent=1)
    sys.exit(0 if all(row.met for row in rows) else 1)


if __name__ == "__main__":
    main()
