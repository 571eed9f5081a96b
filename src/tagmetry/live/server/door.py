"""What stands before the requests of rooms: each is answered to those who may ask it."""

from fastapi import Request, Response

from tagmetry.live.messages import Role
from tagmetry.live.rooms.room import Answer, words
from tagmetry.live.server.access import Access


def behind(access: Access, role: Role | None, answer: Answer) -> Answer:
    """Return an answer for those who have a role, and a refusal for all others.

    Args:
        access: Says who may do what.
        role: That is needed; an operator may do what a viewer may. None: anybody.
        answer: What is answered.
    """

    async def checked(request: Request) -> Response:
        own = access.role(request.cookies.get(access.cookie))
        if role is None or own in (role, "operator"):
            return await answer(request)
        return words("sign in with the token", 403)

    return checked
