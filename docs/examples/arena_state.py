from tagmetry.files import load_camera
from tagmetry.files.arena import load_arena
from tagmetry.pipeline.arena import ArenaMeasurement, calibrate_arena, run_arena
from tagmetry.sources import open_source

setup = load_arena("lab.yaml")
camera = load_camera("ceiling.yaml")
with open_source("floor.png", camera=camera) as floor:
    world = calibrate_arena(floor, setup, camera)

task = ArenaMeasurement.of(setup, world)
with open_source("drive", camera=camera) as images:
    for result in run_arena(images, task):
        for robot in result.world:
            sd_mm = 1000 * robot.covariance[0, 0] ** 0.5
            print(f"{robot.name}: x {robot.x_m:+.3f} m +-{sd_mm:.2f} mm")
        for told in result.told:
            print(f"robot {told.robot_id} knows of {[near.id for near in told.neighbours]}")
