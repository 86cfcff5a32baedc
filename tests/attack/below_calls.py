"""Attacks on HTTP/2 itself, each beside a client whose calls are timed."""
import time

import http2_attacks
from client import Client, Row
from probe import Probe
from proxy import Proxy
from server import Server

STATUS = "/clearway.v1.ServerService/GetStatus"


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
                row = self.below_the_calls(attack, server, [server], others_ms=1000, more_mb=1536)
                yield Row(attack.__name__, row.seen, row.met)

    def attack_proxied_http2(self):
        """The same through the proxy that is shipped."""
        if not self.proxy:
            yield Row("HTTP/2 attacks through the proxy", "not made: there is no haproxy", False)
            return
        for attack in http2_attacks.ALL:
            with self.server() as server, Proxy(self.proxy, server.address) as proxy:
                row = self.below_the_calls(attack, proxy, [server, proxy], others_ms=50, more_mb=64)
                yield Row(f"{attack.__name__}, through the proxy", row.seen, row.met)

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
            time.sleep(2)
            after = probe.take()
        alive = all(p.alive() for p in programs)
        if not alive or not during["n"] or not after["n"]:
            return Row("", f"{told}; alive: {alive}; nobody was answered", False)
        return Row("", f"{told}; +{grown_mb:.0f} MB; others p99 {during['p99_ms']:.0f} ms, at most "
                   f"{during['most_ms']:.0f} ms, {during['failed']} failed{''.join(' ' + e for e in during['errors'])}; after p99 "
                   f"{after['p99_ms']:.0f} ms",
                   during["p99_ms"] <= others_ms and during["most_ms"] <= 1000 and
                   during["failed"] == 0 and grown_mb <= more_mb)
