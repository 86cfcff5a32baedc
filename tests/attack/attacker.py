"""Large calls from a process of its own, of low priority: attackers are other machines, and what
they compute must not be counted as the server's doing.

As a program: attacker.py ADDRESS METHOD CLIENTS CALLS_EACH; its input is the request. Prints a
line once all calls are sent, and their codes as JSON once all have ended.
"""
import json
import os
import subprocess
import sys

NICENESS = 10


class Attacker:
    """So many clients, each on a connection of its own, with so many calls at once."""

    def __init__(self, address, method, body, clients=1, calls_each=8):
        self.process = subprocess.Popen(
            [sys.executable, __file__, address, method, str(clients), str(calls_each)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.process.stdin.write(body)
        self.process.stdin.close()
        self.process.stdout.readline()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def codes(self):
        """Of all calls, once the last has ended."""
        return json.loads(self.process.stdout.readline())


def main(address, method, clients, calls_each):
    os.nice(NICENESS)  # before gRPC starts its threads
    import client
    body = sys.stdin.buffer.read()
    running = [sender.begin(method, body)
               for sender in [client.Client(address) for _ in range(int(clients))]
               for _ in range(int(calls_each))]
    print("sent", flush=True)
    print(json.dumps([call.code().name for call in running]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
