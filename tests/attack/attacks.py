"""The attacks, each beside a client whose calls are timed."""
import contextlib
import os
import random
import signal
import socket
import subprocess
import sys
import time

import calls
import http2
from attacker import Attacker
from below_calls import MOST_MB, AttacksBelowCalls
from client import Client, Row
from probe import Probe

STATES = "/clearway.v1.CheckService/CheckStates"
MUTATIONS_PER_S = 3334  # 100,000 in 30 s
FOLLOW = "/clearway.v1.FollowService/FollowScene"
HEAVY = ["ObjectService/PredictPoses", "OccupancyService/GetBoxOccupancy",
         "OccupancyService/GetPointOccupancy", "OccupancyService/CastRays",
         "CheckService/CheckStates", "IngestService/PushFrame"]


class Attacks(AttacksBelowCalls):
    """Each method whose name begins with attack_ is one; it returns its rows."""

    def robot(self, client):
        reply = self.stubs.check.RegisterRobotResponse()
        reply.ParseFromString(client.call("CheckService/RegisterRobot", self.stubs.ball()))
        return reply.robot_id

    def heavy(self, method, client):
        """The largest legal request of a method that computes, as bytes."""
        make = {
            "ObjectService/PredictPoses": lambda: self.stubs.poses(700, 700),
            "OccupancyService/GetBoxOccupancy": self.stubs.box_of_cells,
            "OccupancyService/GetPointOccupancy": lambda: self.stubs.points(4_000_000),
            "OccupancyService/CastRays": lambda: self.stubs.rays(500_000, 1e300),
            "CheckService/CheckStates": lambda: self.stubs.states(self.robot(client), 20_000),
            "IngestService/PushFrame": lambda: self.stubs.long_rays(1000, 99_000.0),
        }
        return make[method]().SerializeToString()

    def attack_legal_requests(self):
        for method in HEAVY:
            yield self.legal_request(method)

    def legal_request(self, method):
        with self.server() as server:
            client = Client(server.address)
            self.fill(client)
            client.call("ObjectService/AddObjects", self.stubs.one_object())
            robot = self.robot(client)
            body = self.heavy(method, client)
            state = self.stubs.states(robot, 1).SerializeToString()
            with Probe(server.address, STATES, state) as probe:
                idle_mb = server.resident_mb()
                server.reset_peak()
                probe.take()
                with self.eight_calls(server, method, body):
                    delays = [self.push_delay_ms(client, 100 + i) for i in range(5)]
                    time.sleep(max(2, self.seconds / 6))
                    seen = probe.take()
            more_mb = server.peak_mb() - idle_mb
            safe = more_mb <= MOST_MB and seen["failed"] == 0 and server.alive()
            return Row(f"8 x {method} at once",
                       f"+{more_mb:.0f} MB; p99 {seen['p99_ms']:.1f} ms; frame after "
                       f"{max(delays):.0f} ms",
                       safe, fast=seen["p99_ms"] <= 25 and max(delays) <= 100)

    @staticmethod
    @contextlib.contextmanager
    def eight_calls(server, method, body):
        """At once, and nobody reads the replies; of requests above 60 KB gRPC reads them."""
        if len(body) > 60_000:
            with Attacker(server.address, method, body):
                yield
            return
        with http2.Connection(server.port, window=1) as attacker:
            for i in range(8):
                attacker.call(2 * i + 1, f"/clearway.v1.{method}", body)
            yield
            if server.alive() and attacker.closed:
                raise RuntimeError(f"{method}: the server closed the connection")

    def push_delay_ms(self, client, sequence):
        push = self.stubs.push(sequence, 1000 + sequence, points=200, sensor="honest")
        start = time.monotonic()
        client.call("IngestService/PushFrame", push)
        return (time.monotonic() - start) * 1e3

    def attack_followers(self):
        one_s, _ = self.frame_cost_s(1, 0)
        many_s, left = self.frame_cost_s(87, 20)
        yield Row("107 followers, 20 do not read",
                  f"{many_s / one_s:.1f} times the processor time of a frame with one ({many_s:.3f} s); "
                  f"{20 - left} of 20 dropped", safe=left == 0, fast=many_s <= 3 * one_s)

    def frame_cost_s(self, readers, stalled):
        """Processor time of a frame, and how many streams of those that do not read are left."""
        with self.server("--limits-max-stall-s", "5") as server:
            client = Client(server.address)
            self.fill(client, frames=3)
            pid = self.follow_in_a_process(server.port, readers, stalled)
            try:
                self.wait_for_followers(client, readers + stalled)
                before_s, frames = server.processor_s(), 30
                for i in range(frames):
                    client.call("IngestService/PushFrame",
                                self.stubs.push(10 + i, 1000 + 10 * i, x=float(i), seed=i))
                cost_s = (server.processor_s() - before_s) / frames
                time.sleep(6)
                status = self.status(client)
                return cost_s, status.follow_streams - readers
            finally:
                pid.kill()
                pid.wait()

    def wait_for_followers(self, client, count):
        for _ in range(100):
            if self.status(client).follow_streams == count:
                return
            time.sleep(0.1)
        raise RuntimeError(f"{self.status(client).follow_streams} of {count} follow")

    def status(self, client):
        from clearway.v1 import server_service_pb2
        reply = server_service_pb2.GetStatusResponse()
        reply.ParseFromString(client.call("ServerService/GetStatus", b""))
        return reply

    @staticmethod
    def follow_in_a_process(port, readers, stalled):
        code = (
            "import select, sys, time; sys.path.insert(0, sys.argv[1]); import http2\n"
            "port, readers, stalled = map(int, sys.argv[2:])\n"
            "all = [http2.Connection(port, window=2**31 - 1, reads=False)"
            " for _ in range(readers + stalled)]\n"
            "for c in all[:readers]: c.widen()\n"
            f"for c in all: c.call(1, {FOLLOW!r}, b'')\n"
            "sockets = [c.socket for c in all[:readers]]\n"
            "while True:\n"
            "  for s in select.select(sockets, [], [], 1)[0]: s.recv(1 << 18)\n")
        return subprocess.Popen([sys.executable, "-c", code, os.path.dirname(__file__), str(port),
                                 str(readers), str(stalled)])

    def attack_heavy_batches(self):
        """Four clients with eight batches each beside one with single states."""
        with self.server() as server:
            client = Client(server.address)
            self.fill(client, frames=20)
            robot = self.robot(client)
            batch = self.stubs.states(robot, 20_000).SerializeToString()
            state = self.stubs.states(robot, 1).SerializeToString()
            with Probe(server.address, STATES, state, gap_s=0.002) as probe:
                time.sleep(3)
                alone = probe.take()
                with Attacker(server.address, "CheckService/CheckStates", batch,
                              clients=4) as attacker:
                    codes = attacker.codes()
                beside = probe.take()
            ratio = beside["p99_ms"] / alone["p99_ms"]
            done = codes.count("OK")
            yield Row("4 x 8 heavy batches beside single states",
                      f"p99 {beside['p99_ms']:.1f} ms, {ratio:.1f} times that alone; {done} of 32 done",
                      safe=done == 32, fast=ratio <= 5)

    def attack_descriptors(self):
        worst_s, served = 0.0, 0
        with self.server(descriptors=256) as server:
            for _ in range(10):
                silent = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(400)]
                time.sleep(0.3)
                for connection in silent:
                    connection.close()
                start = time.monotonic()
                code = ""
                while code != "OK" and time.monotonic() - start < 5:
                    code = Client(server.address).code("ServerService/GetStatus", b"", 5)
                served += code == "OK"
                worst_s = max(worst_s, time.monotonic() - start)
        yield Row("descriptors run out, ten times",
                  f"{served} of 10 new clients served, after {worst_s:.2f} s at most",
                  safe=served == 10, fast=worst_s <= 1)

    def attack_signals(self):
        for method in HEAVY:
            yield self.ended_during(method)

    def ended_during(self, method):
        ends = []
        for twice in (False, True):
            with self.server() as server:
                client = Client(server.address)
                self.fill(client)
                client.call("ObjectService/AddObjects", self.stubs.one_object())
                body = self.heavy(method, client)
                with self.eight_calls(server, method, body):
                    time.sleep(1)
                    if twice:
                        server.process.send_signal(signal.SIGTERM)
                        time.sleep(0.2)
                    ends.append(server.stop())
        (code, first_s), (_, second_s) = ends
        return Row(f"SIGTERM during 8 x {method}",
                   f"exit {code} after {first_s:.1f} s; a second one {second_s:.2f} s",
                   safe=code == 0, fast=first_s <= 11 and second_s <= 0.5)

    def attack_mutations(self):
        """Requests of all kinds with bytes changed; none may change the scene when it is refused."""
        dice, codes, slowest_s, changed = random.Random(5), {}, 0.0, 0
        with self.server("--limits-max-planning-s", "0.05") as server:
            client = Client(server.address)
            self.fill(client, frames=3)
            seeds = {m: r.SerializeToString() for m, r in self.small(client).items()}
            for _ in range(int(MUTATIONS_PER_S * self.seconds)):
                if not server.alive():
                    break
                method = dice.choice(list(seeds))
                version = self.status(client).scene.version
                start = time.monotonic()
                code = client.code(method, calls.mutate(seeds[method], dice), 20)
                slowest_s = max(slowest_s, time.monotonic() - start)
                codes[code] = codes.get(code, 0) + 1
                if code != "OK" and self.status(client).scene.version != version:
                    changed += 1
            bad = sum(codes.get(code, 0) for code in ("INTERNAL", "UNKNOWN", "DEADLINE_EXCEEDED"))
            yield Row(f"{sum(codes.values())} mutated requests",
                      f"{dict(sorted(codes.items()))}; the slowest took {slowest_s:.1f} s; "
                      f"{changed} refused ones changed the scene",
                      safe=server.alive() and bad == 0 and changed == 0, fast=slowest_s < 5)

    def small(self, client):
        """Of each method that takes more than an id or two."""
        return {
            "IngestService/PushFrame": self.stubs.push(10, 2000, points=20),
            "CheckService/RegisterRobot": self.stubs.ball(),
            "CheckService/CheckStates": self.stubs.states(self.robot(client), 3),
            "OccupancyService/GetPointOccupancy": self.stubs.points(3),
            "OccupancyService/GetBoxOccupancy": self.stubs.box_of_cells(1.0, 1.0),
            "OccupancyService/CastRays": self.stubs.rays(3, 50.0),
            "ObjectService/PredictPoses": self.stubs.poses(2, 2),
            "ObjectService/AddObjects": self.stubs.one_object(),
        }
