from pathlib import Path

from tagmetry.live.client import LiveClient
from tagmetry.live.opening import opened_page

# usually `tagmetry live` runs, and prints URL and token
here = ("127.0.0.1", 0, Path("recordings"))
with (
    opened_page("leader_follower", 2, *here, pictures=False) as page,
    LiveClient(page.url, page.token) as live,
):
    live.set_parameter("length_m", 0.25)  # of the spring that ties the follower
    live.follow_path(0, [(-0.7, 0.2), (-0.5, 0.2)])
    for world in live.worlds(seconds=3.0):
        leader, follower = world.robots
    print(f"{leader.name} is on a {leader.task} at {leader.x_m:+.2f}, {leader.y_m:+.2f} m")
    print(f"{follower.name} turns its wheels at {follower.wheels_radps} rad/s")
