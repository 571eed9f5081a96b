"""What was recorded, for operators to list and to fetch: only files that the list names."""

from collections.abc import Awaitable, Callable

from fastapi import Request, Response
from fastapi.responses import FileResponse, JSONResponse

from tagmetry.live.access import Access
from tagmetry.live.running import Runner


class Shelf:
    """The folder of recordings behind the operator's door."""

    def __init__(self, access: Access, runner: Runner) -> None:
        self._access, self._runner = access, runner

    @property
    def routes(self) -> dict[str, Callable[..., Awaitable[Response]]]:
        """What answers each path."""
        return {"/recordings": self.show, "/recordings/{name}": self.fetch}

    async def show(self, request: Request) -> Response:
        """Return names and sizes, the newest first."""
        if not self._is_operator(request):
            return _refusal()
        sizes = self._sizes_bytes()
        names = sorted(sizes, reverse=True)
        return JSONResponse([{"name": name, "size_bytes": sizes[name]} for name in names])

    async def fetch(self, request: Request, name: str) -> Response:
        """Return one recording."""
        if not self._is_operator(request):
            return _refusal()
        if name not in self._sizes_bytes():
            return Response("there is no such recording", 404, media_type="text/plain")
        path = self._runner.recordings / name
        return FileResponse(path, media_type="application/octet-stream", filename=name)

    def _is_operator(self, request: Request) -> bool:
        return self._access.role(request.cookies.get(self._access.cookie)) == "operator"

    def _sizes_bytes(self) -> dict[str, int]:
        found = self._runner.recordings.glob("*.mcap")
        files = [path for path in found if path.is_file() and not path.is_symlink()]
        return {path.name: path.stat().st_size for path in files}


def _refusal() -> Response:
    return Response("sign in with the token", 403, media_type="text/plain")
