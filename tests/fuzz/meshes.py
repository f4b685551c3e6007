"""Writes into the corpus of the target `meshes` what other people's bug reports are about: python3 meshes.py FOLDER

Each file is the bytes of one scene as `tools/testing/src/fuzz/meshes.rs` reads them, and then what `reported.rs` does to it.
"""

import sys
from pathlib import Path

FOLDER = Path(sys.argv[1])


def scene(joints=3, bend=0, thickness=60, double=1):
    """A sleeve of 6 x 8 vertices on an arm of 6 x 8, up to what follows the budget."""
    sleeve, arm = 6 * 8, 6 * 8
    drawn = [joints - 2, bend] + [0] * 4 * joints
    drawn += [96, 0, 64, 200]  # radius, ripple, ends
    drawn += [4, 5] + [0] * sleeve + [0]  # rings, sides, radii, no lining
    drawn += [thickness, 0, 4, 5, 100, 100, 0] + [0] * arm + [0]  # the arm, closed; no source body
    drawn += [0, 0] + [0, 0, 0, 0, 0] * 2 + [double, 0]  # no damage, places, precision, padding
    return drawn + [39, 40, 0, 0]  # iterations, voxels, threads, budget


REPORTED = {
    "whole": [],
    "loose_pieces": [1, 40, 90, 10, 0, 1, 10, 200, 40, 30, 1, 255, 0, 120, 250],
    "t_junctions": [2, 3, 2, 17, 2, 40],
    "touching_corners": [3, 5, 127, 3, 20, 60, 3, 41, 10],
    "garment_in_centimetres": [4, 0, 0],
    "garment_times_2.54": [4, 2, 0],
    "avatar_in_inches": [4, 1, 1],
    "source_skeleton_in_millimetres": [4, 3, 2],
    "target_skeleton_in_feet": [4, 5, 3],
    "mirrored_skeleton": [5, 0, 0],
    "mirrored_target": [5, 0, 2],
    "turned_target": [5, 1, 2],
    "upside_down_target": [5, 2, 2],
    "joints_in_another_order": [5, 0, 3],
    "weights_on_the_root": [6, 0],
    "weights_on_the_end": [6, 2],
    "holes": [7, 3],
    "a_net": [7, 0],
    "bow_ties": [8, 0],
    "bow_ties_of_two": [8, 1],
    "floor": [9, 200, 20],
    "horn": [10, 60, 20, 0],
    "long_horn": [10, 255, 60, 30],
    "horn_and_weights_on_the_root": [10, 120, 40, 0, 6, 0],
    "garment_turned_by_45_degrees": [11, 0, 0, 32],
    "avatar_turned_by_60_degrees": [11, 1, 1, 43],
    "source_skeleton_turned_by_90_degrees": [11, 2, 0, 64],
    "target_skeleton_turned_by_30_degrees": [11, 3, 1, 21],
    "garment_times_1.7": [12, 42, 0],
    "avatar_times_0.4": [12, 183, 1],
    "source_skeleton_times_3": [12, 87, 2],
    "source_limb_turned_by_80_degrees": [13, 0, 1, 1, 57],
    "target_limb_turned_by_60_degrees": [13, 1, 1, 0, 43],
    "wings": [14, 90, 60, 0],
    "wings_across_the_hem": [14, 200, 30, 150],
    "belt": [15, 80, 60, 0, 0],
    "belt_tilted_by_25_degrees": [15, 30, 120, 0, 18],
    "necklace": [16, 100, 80, 0, 0],
    "necklace_tilted_by_10_degrees": [16, 20, 60, 1, 7],
    "cape": [17, 200, 120, 60, 2, 0],
    "cape_with_a_closed_collar": [17, 180, 90, 40, 1, 1],
    "belt_with_wings": [15, 80, 60, 0, 0, 14, 90, 60, 0],
    "cape_turned_by_50_degrees": [17, 180, 90, 40, 1, 1, 11, 0, 2, 36],
    "pieces_on_a_net": [1, 40, 90, 10, 0, 7, 4, 3, 5, 60],
    "floor_and_units": [9, 200, 20, 4, 2, 0],
}

for name, bytes_ in REPORTED.items():
    (FOLDER / name).write_bytes(bytes(scene() + bytes_))
    (FOLDER / f"{name}_bent").write_bytes(bytes(scene(joints=5, bend=255, thickness=90, double=0) + bytes_))
