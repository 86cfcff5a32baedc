"""What the attacks share: a client that calls by name, and a row of the table."""
import dataclasses

import grpc


@dataclasses.dataclass
class Row:
    """`safe`: all that does not depend on how fast the machine is; `fast`: the rest of the bar."""
    attack: str
    seen: str
    safe: bool
    fast: bool

    @property
    def verdict(self):
        return "met" if self.safe and self.fast else "NOT MET"


class Client:
    """Calls by name, with messages or bytes."""

    def __init__(self, address):
        self.channel = grpc.insecure_channel(address, options=[
            ("grpc.use_local_subchannel_pool", 1), ("grpc.max_receive_message_length", -1),
            ("grpc.max_send_message_length", -1)])

    def call(self, method, request, timeout_s=60):
        """The reply's bytes. Raises grpc.RpcError."""
        octets = request if isinstance(request, bytes) else request.SerializeToString()
        return self.channel.unary_unary(f"/clearway.v1.{method}", request_serializer=bytes,
                                        response_deserializer=bytes)(octets, timeout=timeout_s)

    def begin(self, method, octets, timeout_s=300):
        """A call in the background."""
        return self.channel.unary_unary(f"/clearway.v1.{method}", request_serializer=bytes,
                                        response_deserializer=bytes).future(octets, timeout_s)

    def code(self, method, request, timeout_s=60):
        try:
            self.call(method, request, timeout_s)
            return "OK"
        except grpc.RpcError as error:
            return error.code().name
