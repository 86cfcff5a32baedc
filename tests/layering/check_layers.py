"""Fails on an include that the architecture forbids (docs/architecture.md, the table of layers).

usage: check_layers.py <root of the source tree>

Prints one line per fault, `file:line: why`, and exits with 1 if there is any.
"""
import re
import sys
from pathlib import Path

# Each layer sees those before it. The client does not see the server, nor the server the client.
LAYERS = ["base", "geometry", "map", "scene", "collision", "planning", "io", "sim", "report",
          "wire", "client", "server"]

# Beyond the order: what a layer must not include although it lies below. Planners see answers, never
# maps; pictures see scenes, not planners; the wire does not need files or simulators.
FORBIDDEN = {
    "planning": ["map"],
    "io": ["planning"],
    "sim": ["planning"],
    "report": ["planning"],
    "wire": ["planning", "io", "sim", "report"],
    "client": ["planning", "io", "sim", "report"],
    "server": ["sim", "report", "client"],
}

# Private headers that others may include: how functions are compiled is no user's business; the
# converters show protobuf types, so they cannot be public, and those who speak the wire format
# need them.
SHARED = {"base": ["geometry", "map", "scene", "collision"], "wire": ["client", "server"]}

# Third-party headers, and the only places (besides tests and benchmarks) that may include them.
THIRD_PARTY = [
    (r"fcl/|ccd/", [r"src/collision/.*(narrow_?phase|fcl)"]),
    (r"ompl/", [r"include/clearway/planning/", r"src/planning/", r"examples/"]),
    (r"octomap/", [r"src/io/"]),
    (r"libqhull|qhull", [r"src/geometry/"]),
    (r"png\.h", [r"src/io/png\.cc"]),
    (r"openssl/", [r"src/(wire|client)/", r"server/"]),
    (r"sqlite3\.h|assimp/", [r"src/io/", r"server/"]),
    (r"zstd\.h", [r"src/(io|wire)/", r"server/"]),
    (r"cairo", [r"src/report/"]),
    (r"pugixml", [r"src/io/", r"clients/cli/"]),
    (r"google/|clearway/v1/|.*\.pb\.h",
     [r"include/clearway/(wire|client)/", r"src/(wire|client)/", r"server/", r"clients/"]),
    (r"grpc|grpcpp/", [r"include/clearway/client/", r"src/(wire|client)/", r"server/", r"clients/",
                       r"examples/"]),
    (r"CLI/|spdlog/|toml\+\+/|nlohmann/|prometheus/",
     [r"src/(?!base|geometry|map|scene|collision|planning)", r"server/", r"clients/",
      r"examples/"]),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
FOLDERS = ["include", "src", "server", "clients", "examples"]


def layer_of_file(path):
    """The layer that a file belongs to; None above all layers (programs and examples)."""
    parts = path.split("/")
    if path.startswith("include/clearway/") and len(parts) > 3:
        return parts[2]
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    return "server" if parts[0] == "server" else None


def layer_of_include(name, root):
    """The layer that an include belongs to, and whether it is private to it."""
    parts = name.split("/")
    if parts[0] == "clearway" and len(parts) > 2 and parts[1] in LAYERS:
        return parts[1], False
    if len(parts) > 1 and parts[0] in LAYERS and (root / "src" / name).exists():
        return parts[0], True
    return None, False


def fault_of_layers(path, name, root):
    own = layer_of_file(path)
    other, private = layer_of_include(name, root)
    if own is not None and own not in LAYERS:
        return f"'{own}' is not a layer"
    if other is None or other == own:
        if private and path.startswith("include/"):
            return f"a public header shows the private '{name}'"
        return None
    if private and own not in SHARED.get(other, []):
        return f"'{name}' is private to {other}"
    if own is None:
        return None
    if LAYERS.index(other) > LAYERS.index(own):
        return f"{own} lies below {other}"
    if other in FORBIDDEN.get(own, []):
        return f"{own} must not see {other}"
    return None


def fault_of_third_party(path, name):
    for pattern, places in THIRD_PARTY:
        if re.match(pattern, name):
            if not any(re.match(place, path) for place in places):
                return f"<{name}> does not belong here"
            return None
    return None


def faults(root):
    """All faults of the tree, by file and line."""
    root = Path(root)
    files = [f for folder in FOLDERS for f in sorted((root / folder).rglob("*"))
             if f.suffix in (".h", ".cc")]
    found = []
    for file in files:
        path = file.relative_to(root).as_posix()
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            name = match.group(2)
            fault = fault_of_layers(path, name, root) or fault_of_third_party(path, name)
            if fault:
                found.append(f"{path}:{number}: {fault}")
    return found, len(files)


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        print(__doc__, file=sys.stderr)
        return 2
    found, count = faults(sys.argv[1])
    print("\n".join(found) if found else f"layers: {count} files, no forbidden include")
    if count == 0:
        print("layers: no files found", file=sys.stderr)
        return 2
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
