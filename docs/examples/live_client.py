from pathlib import Path

from tagmetry.live.client import LiveClient
from tagmetry.live.opening import opened_page
from tagmetry.live.show.programme import Programme

# usually `tagmetry live` runs, and prints URL and token
programme = Programme("leader_follower", 2, Path("recordings"), pictures=False)
with (
    opened_page(programme, "127.0.0.1", 0) as page,
    LiveClient(page.url, page.token) as live,
):
    live.set_parameter("length_m", 0.25)  # of the spring that ties the follower
    live.follow_path(0, [(-0.7, 0.2), (-0.5, 0.2)])
    for world in live.worlds(seconds=3.0):
        leader, follower = world.robots
    print(f"{leader.name} is on a {leader.task} at {leader.x_m:+.2f}, {leader.y_m:+.2f} m")
    print(f"{follower.name} turns its wheels at {follower.wheels_radps} rad/s")
