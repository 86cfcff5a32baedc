"""Attacks a server of this machine and prints what came of it, as a table and as JSON.

usage: attack.py --server PROGRAM --proto FOLDER [--seconds S] [--only WORD] [--json FILE]
                 [--proxy FILE] [--quick]

With the configuration of a HAProxy, the attacks below the calls are made through it, too. The exit
code is 1 if a bar is not met; with --quick, which gives each attack half a second, only if one is
not met that does not depend on the machine's speed.
"""
import argparse
import dataclasses
import glob
import json
import os
import subprocess
import sys
import tempfile

os.environ.setdefault("GRPC_VERBOSITY", "NONE")  # what fails is counted

import calls
from attacks import Attacks


def make_stubs(proto, folder):
    files = [name for part in ("clearway/v1", "google/rpc")
             for name in glob.glob(f"{proto}/{part}/*.proto")]
    subprocess.run(["protoc", "-I", proto, f"--python_out={folder}", *files], check=True)


def made(attacks, only):
    """The rows of the attacks whose name holds `only`, printed as they come."""
    for name in [n for n in dir(attacks) if n.startswith("attack_") and only in n]:
        for row in getattr(attacks, name)():
            print(f"| {row.attack} | {row.seen} | {row.verdict} |", flush=True)
            yield row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--server", required=True, help="the program clearway-server")
    parser.add_argument("--proto", required=True, help="folder of the .proto files")
    parser.add_argument("--seconds", type=float, default=30, help="how long each attack goes on")
    parser.add_argument("--only", default="", help="attacks whose name holds this word")
    parser.add_argument("--proxy", help="configuration of a HAProxy to attack through")
    parser.add_argument("--json", help="file to write the rows to")
    parser.add_argument("--quick", action="store_true", help="short, and judge no times")
    arguments = parser.parse_args()
    seconds = 0.5 if arguments.quick else arguments.seconds
    with tempfile.TemporaryDirectory() as stubs:
        make_stubs(arguments.proto, stubs)
        attacks = Attacks(arguments.server, calls.Stubs(stubs), seconds, arguments.proxy)
        rows = list(made(attacks, arguments.only))
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as out:
            json.dump([dataclasses.asdict(row) for row in rows], out, indent=1)
    sys.exit(0 if all(row.safe and (row.fast or arguments.quick) for row in rows) else 1)


if __name__ == "__main__":
    main()
