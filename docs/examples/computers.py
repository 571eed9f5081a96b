import numpy as np

from tagmetry.arena import RobotState
from tagmetry.link import Command, new_key, now_us, parse_key
from tagmetry.link.computers import ArenaBridge, ArenaView, Commander, state_message
from tagmetry.link.messages import ArenaState

ENDPOINT, KEY = "tcp/127.0.0.1:47475", parse_key(new_key())


def tell(bridge: ArenaBridge, image: int) -> None:
    """Tell of one image with one robot; usually `tagmetry arena run` does."""
    ada = RobotState(3, "ada", 0.4, 0.1, 0.0, 0.0, 0.0, 1e-6 * np.eye(5), 0.0, True, 0.0)
    moment_us = now_us()
    bridge.tell(3, state_message(ada, moment_us, must_stand=False))
    bridge.tell_image(ArenaState(moment_us, image, flags=0, robots=1, seen=1))


with (
    ArenaBridge("lab", {3: "ada"}, listen=ENDPOINT, command_key=KEY) as bridge,
    ArenaView(ENDPOINT, "lab") as view,  # on any computer
    Commander(ENDPOINT, [3], KEY, "lab") as commander,  # on one that has the key
):
    for image in range(1000):
        tell(bridge, image)
        sight = view.wait(0.01)
        is_linked = commander.send(3, Command(forward_mps=0.2, valid_for_ms=200))
        if sight is not None and is_linked and bridge.command(3) != Command():
            break
    for robot in sight.world:
        sd_mm = 1000 * robot.covariance[0, 0] ** 0.5
        print(f"{robot.name}: x {robot.x_m:.2f} m ± {sd_mm:.0f} mm, seen {robot.age_s:.1f} s ago")
    print(f"commanded: {bridge.command(3).forward_mps:.1f} m/s")
