"""The C client's sources, as they lie in the installed package."""

from importlib.resources import files


def client_sources() -> dict[str, bytes]:
    """Return each file's name and content: the packets, the client, POSIX sockets, and the twin."""
    folder = files("tagmetry.link.client")
    return {
        one.name: one.read_bytes()
        for one in sorted(folder.iterdir(), key=lambda one: one.name)
        if one.name.endswith((".c", ".h"))
    }
