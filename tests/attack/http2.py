"""HTTP/2 by hand (RFC 9113), for what no well-behaved client sends."""
import socket
import struct
import threading

PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
DATA, HEADERS, RST_STREAM, SETTINGS, PING, WINDOW_UPDATE, CONTINUATION = 0, 1, 3, 4, 6, 8, 9
END_STREAM, END_HEADERS = 1, 4
INITIAL_WINDOW_SIZE = 4
LARGEST_FRAME = 16384
CANCEL = struct.pack(">I", 8)


def frame(kind, flags, stream, payload=b""):
    return (struct.pack(">I", len(payload))[1:] + bytes([kind, flags]) +
            struct.pack(">I", stream) + payload)


def integer(value, prefix_bits):
    """An integer of HPACK (RFC 7541, 5.1) whose prefix's other bits are zero."""
    most = (1 << prefix_bits) - 1
    if value < most:
        return bytes([value])
    encoded = bytes([most])
    value -= most
    while value >= 128:
        encoded += bytes([value & 127 | 128])
        value >>= 7
    return encoded + bytes([value])


def header(name, value):
    """A field that is never indexed (RFC 7541, 6.2.3)."""
    name, value = name.encode(), value if isinstance(value, bytes) else value.encode()
    return b"\x10" + integer(len(name), 7) + name + integer(len(value), 7) + value


def request_headers(path, *more):
    fields = [(":method", "POST"), (":scheme", "http"), (":path", path), (":authority", "x"),
              ("content-type", "application/grpc"), ("te", "trailers"), *more]
    return b"".join(header(name, value) for name, value in fields)


def message(body, compressed=False):
    return bytes([compressed]) + struct.pack(">I", len(body)) + body


def connect(port):
    """To a port of this machine, but from another address than honest clients have."""
    return socket.create_connection(("127.0.0.1", port), source_address=("127.0.0.2", 0))


class Connection:
    """To a port of this machine. `window` is what the server may send on each stream."""

    def __init__(self, port, window=65535, reads=True):
        self.socket = connect(port)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.closed = False
        self.send(PREFACE + frame(SETTINGS, 0, 0, struct.pack(">HI", INITIAL_WINDOW_SIZE, window)))
        if reads:
            threading.Thread(target=self._read, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def _read(self):
        try:
            while self.socket.recv(1 << 16):
                pass
        except OSError:
            pass
        self.closed = True

    def send(self, octets):
        """False once the server has closed the connection."""
        try:
            self.socket.sendall(octets)
        except TimeoutError:
            return True  # it reads nothing for now
        except OSError:
            self.closed = True
        return not self.closed

    def widen(self, octets=2**31 - 65536):
        """The window of the connection."""
        return self.send(frame(WINDOW_UPDATE, 0, 0, struct.pack(">I", octets)))

    def call(self, stream, path, body, *more_headers, compressed=False):
        """A whole call with one message. The server's windows are not heeded: it lets in 64 KB."""
        pieces = [frame(HEADERS, END_HEADERS, stream, request_headers(path, *more_headers))]
        whole = message(body, compressed)
        for start in range(0, len(whole), LARGEST_FRAME):
            last = start + LARGEST_FRAME >= len(whole)
            pieces.append(frame(DATA, END_STREAM if last else 0, stream,
                                whole[start:start + LARGEST_FRAME]))
        return self.send(b"".join(pieces))
