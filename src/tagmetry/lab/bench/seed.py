"""Seed 001's figure 10: how many images a second its overhead vision made, by number of robots.

Its text gives these points of the curve; at which number it was 22 a second is not said.
"""

CAMERA_HZ = 120.0  # without robots: the camera gives no more
ROBOTS = (13, 24)
IMAGES_PER_S = (60.0, 30.0)
LEAST_IMAGES_PER_S = 22.0
