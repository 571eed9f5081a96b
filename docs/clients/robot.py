import sys

from tagmetry.link import Odometry, RobotClient, Telemetry, parse_key


def drive(forward_mps: float, turn_radps: float) -> None:
    """Set the motors here."""


address, port, key = sys.argv[1:]
with RobotClient(3, parse_key(key), address, int(port)) as robot:
    while True:
        robot.step(0.01)
        wanted = robot.command  # zeros if the host is gone
        drive(wanted.forward_mps, wanted.turn_radps)
        for seen in robot.neighbours.seen if robot.neighbours else ():
            print(f"robot {seen.id} at {seen.range_m:.2f} m", flush=True)
        if robot.is_linked:
            now_us = robot.host_us
            robot.send(Odometry(now_us, 0.0, 0.0, 0.0, wanted.forward_mps))
            robot.send(Telemetry(now_us, (("volt", 7.4),)))
