"""Attacks on HTTP/2 itself, each beside a client whose calls are timed."""
import time

import http2_attacks
from client import Client, Row
from probe import Probe
from proxy import PROGRAM, Proxy
from server import Server

STATUS = "/clearway.v1.ServerService/GetStatus"
MOST_MB = 1536  # more memory than before
# gRPC 1.51 has no defence against these: others are answered meanwhile only behind a proxy.
FOR_THE_PROXY = [http2_attacks.rapid_reset, http2_attacks.rapid_reset_of_streams,
                 http2_attacks.continuation, http2_attacks.large_headers]


class AttacksBelowCalls:
    """On HTTP/2 itself, of servers and of servers behind the proxy."""

    def __init__(self, program, stubs, seconds, proxy=None):
        """`proxy`: its configuration, or None to leave it out."""
        self.program, self.stubs, self.seconds, self.proxy = program, stubs, seconds, proxy

    def server(self, *flags, **options):
        return Server(self.program, *flags, **options)

    def fill(self, client, frames=10, points=2000):
        for i in range(1, frames + 1):
            client.call("IngestService/PushFrame",
                        self.stubs.push(i, 100 * i, points=points, x=float(i), seed=i))

    def attack_http2(self):
        for attack in http2_attacks.ALL:
            with self.server() as server:
                row = self.below_the_calls(attack, server, [server], others_ms=1000,
                                           more_mb=MOST_MB)
                if attack in FOR_THE_PROXY:
                    row.seen += "; only behind the proxy"
                    row.fast = True
                yield row

    def attack_proxied_http2(self):
        """The same through the proxy that is shipped."""
        if not self.proxy:
            return
        if not PROGRAM:
            yield Row("HTTP/2 attacks through the proxy", "not made: there is no haproxy",
                      safe=False, fast=False)
            return
        for attack in http2_attacks.ALL:
            with self.server() as server, Proxy(self.proxy, server.address) as proxy:
                row = self.below_the_calls(attack, proxy, [server, proxy], others_ms=50, more_mb=64)
                row.attack += ", through the proxy"
                yield row

    def below_the_calls(self, attack, target, programs, others_ms, more_mb):
        """Of the attacked programs' memory together, and of other clients of the same target."""
        self.fill(Client(target.address), frames=3)
        with Probe(target.address, STATUS, timeout_s=5) as probe:
            time.sleep(1)
            probe.take()
            before_mb = sum(p.resident_mb() for p in programs)
            for program in programs:
                program.reset_peak()
            told = attack(target.port, self.seconds)
            time.sleep(1)  # some are over at once
            during = probe.take()
            grown_mb = sum(p.peak_mb() for p in programs) - before_mb
            after = self.served_again(probe)
        alive = all(p.alive() for p in programs)
        others = (f"p99 {during['p99_ms']:.0f} ms, at most {during['most_ms']:.0f} ms, "
                  f"{during['failed']} failed {' '.join(during['errors'])}".rstrip()
                  if during["n"] else "are not answered")
        return Row(attack.__name__, f"{told}; +{grown_mb:.0f} MB; others {others}; "
                   f"{'' if after else 'not '}served afterwards",
                   safe=alive and after and grown_mb <= more_mb,
                   fast=during["n"] > 0 and during["failed"] == 0 and
                   during["p99_ms"] <= others_ms and during["most_ms"] <= 1000)

    @staticmethod
    def served_again(probe, patience_s=60):
        """Whether others' calls succeed once the attack is over."""
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            time.sleep(1)
            seen = probe.take()
            if seen["n"] > seen["failed"]:
                return True
        return False
