import numpy as np

from tagmetry.markers import generate_family

robots = generate_family(
    "robots", data_cells=5, count=12, minimum_distance=9, rng=np.random.default_rng(7)
)
print(robots, "repairs", robots.correction_bits, "bits; distance", robots.minimum_distance())
print(robots.picture(0).astype(int))  # 1 is white
