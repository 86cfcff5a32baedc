"""A clearway-server in a process of its own, and what it costs the machine."""
import os
import signal
import subprocess
import tempfile
import time


def memory_mb(pid, key):
    """Of a process: VmRSS is what it has, VmHWM the most since reset_peak."""
    try:
        with open(f"/proc/{pid}/status", encoding="ascii") as status:
            for line in status:
                if line.startswith(key + ":"):
                    return int(line.split()[1]) / 1024
    except OSError:
        pass
    return 0.0


def reset_peak(pid):
    """Where the kernel cannot, the peak is that since the process began: no less."""
    try:
        with open(f"/proc/{pid}/clear_refs", "w", encoding="ascii") as refs:
            refs.write("5")
    except OSError:
        pass


class Server:
    """Runs from construction on; `stop` or `kill` ends it."""

    def __init__(self, program, *flags, descriptors=None):
        self.log = tempfile.TemporaryFile()
        limit = ["prlimit", f"--nofile={descriptors}:{descriptors}"] if descriptors else []
        self.process = subprocess.Popen(
            [*limit, program, "--listen", "127.0.0.1:0", *flags],
            stdout=subprocess.PIPE, stderr=self.log)
        line = self.process.stdout.readline().decode()
        if not line.startswith("listening on "):
            raise RuntimeError(f"the server did not start: {self.log_text()}")
        self.address = line.split()[-1]
        self.port = int(self.address.rsplit(":", 1)[1])
        self.pid = self.process.pid

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()

    def log_text(self):
        self.log.seek(0)
        return self.log.read().decode(errors="replace")

    def resident_mb(self):
        return memory_mb(self.pid, "VmRSS")

    def peak_mb(self):
        """The most since reset_peak."""
        return memory_mb(self.pid, "VmHWM")

    def reset_peak(self):
        reset_peak(self.pid)

    def processor_s(self):
        with open(f"/proc/{self.pid}/stat", encoding="ascii") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.pid}/fd"))

    def alive(self):
        return self.process.poll() is None

    def stop(self, patience_s=60):
        """Sends SIGTERM; the exit code and how many seconds it took, or None if it goes on."""
        start = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        try:
            return self.process.wait(patience_s), time.monotonic() - start
        except subprocess.TimeoutExpired:
            return None, time.monotonic() - start

    def kill(self):
        if self.alive():
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.log.close()
