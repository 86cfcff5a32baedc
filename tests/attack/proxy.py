"""The shipped proxy, HAProxy, in front of a server."""
import os
import shutil
import socket
import subprocess
import time

from server import memory_mb, reset_peak

PROGRAM = shutil.which("haproxy", path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Proxy:
    """Runs from construction on; `kill` ends it."""

    def __init__(self, config, server_address):
        self.port = free_port()
        self.address = f"127.0.0.1:{self.port}"
        self.process = subprocess.Popen(
            [PROGRAM, "-q", "-db", "-f", config],
            env={**os.environ, "CLEARWAY_PROXY": self.address, "CLEARWAY_SERVER": server_address})
        self._wait()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def alive(self):
        return self.process.poll() is None

    def resident_mb(self):
        return memory_mb(self.process.pid, "VmRSS")

    def peak_mb(self):
        return memory_mb(self.process.pid, "VmHWM")

    def reset_peak(self):
        reset_peak(self.process.pid)

    def _wait(self):
        for _ in range(100):
            if not self.alive():
                break
            try:
                socket.create_connection(("127.0.0.1", self.port)).close()
                return
            except OSError:
                time.sleep(0.05)
        raise RuntimeError("the proxy did not start")
