"""A small client in a process of its own: one short call after the other, and how long they take.

As a program: probe.py ADDRESS METHOD REQUEST_HEX GAP_S TIMEOUT_S; answers each line of its input
with a line of JSON about the calls since the one before.
"""
import json
import subprocess
import sys
import threading
import time


def percentile(values, fraction):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(len(ordered) * fraction))] if ordered else None


class Probe:
    """Starts to call at once."""

    def __init__(self, address, method, request=b"", gap_s=0.005, timeout_s=10):
        self.process = subprocess.Popen(
            [sys.executable, __file__, address, method, request.hex(), str(gap_s), str(timeout_s)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.take()  # once it runs

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def take(self):
        """Of the calls since the last one: n, failed, p50_ms, p99_ms, most_ms, errors."""
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


def main(address, method, request_hex, gap_s, timeout_s):
    import grpc
    request = bytes.fromhex(request_hex)
    channel = grpc.insecure_channel(address)
    call = channel.unary_unary(method, request_serializer=bytes, response_deserializer=bytes)
    lock, times_ms, errors = threading.Lock(), [], []

    def run():
        while True:
            start = time.monotonic()
            error = None
            try:
                call(request, timeout=float(timeout_s))
            except grpc.RpcError as refusal:
                error = refusal.code().name
            with lock:
                times_ms.append((time.monotonic() - start) * 1e3)
                if error:
                    errors.append(error)
            time.sleep(float(gap_s))

    threading.Thread(target=run, daemon=True).start()
    for _ in sys.stdin:
        with lock:
            taken, failed = times_ms[:], errors[:]
            times_ms.clear()
            errors.clear()
        print(json.dumps({
            "n": len(taken), "failed": len(failed), "p50_ms": percentile(taken, 0.5),
            "p99_ms": percentile(taken, 0.99), "most_ms": max(taken, default=None),
            "errors": sorted(set(failed))}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
