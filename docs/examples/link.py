import time

from tagmetry.link import (
    Command,
    Host,
    Neighbour,
    Neighbours,
    RobotClient,
    new_key,
    now_us,
    parse_key,
)

key = parse_key(new_key())  # in an arena's file it stands beside the robot
others = (Neighbour(id=7, range_m=0.31, bearing_rad=0.5, heading_rad=-1.0),)

with Host({3: key}, port=0) as host, RobotClient(3, key, port=host.address[1]) as robot:
    while robot.neighbours is None:
        host.send(3, Neighbours(now_us(), range_limit_m=0.5, seen=others))
        host.send(3, Command(forward_mps=0.2, valid_for_ms=200))
        robot.step(0.02)
    seen = robot.neighbours.seen[0]
    print(f"robot {seen.id} is {seen.range_m} m away, drive at {robot.command.forward_mps:.1f} m/s")
    time.sleep(0.25)
    print(f"a quarter of a second later: {robot.command.forward_mps} m/s")
