"""Leader and follower in the twin: how far apart are they, and what do wheels and camera say?"""

from tagmetry.pipeline.arena_twin import TwinArena
from tagmetry.pipeline.arena_twin.ready import ready_scenario

arena = TwinArena(ready_scenario("leader_follower", robots=2))
for moment in arena.run(6.0):
    leader, follower = moment.places[0], moment.places[1]
print(f"true distance {1000 * leader.distance_m(follower):.1f} mm")
for robot in moment.turn.step.world:
    print(f"{robot.name}: camera x {robot.x_m:.4f} m, truly {moment.places[robot.id].x_m:.4f} m")
print(f"wheels of robot 0: {moment.odometry[0].x_m:.3f} m from where it began")
arena.close()
