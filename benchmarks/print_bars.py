#!/usr/bin/env python3
"""Prints the numbers of a summary.json that have a bar, and whether they meet it.

usage: print_bars.py summary.json
"""
import json
import sys

AT_LEAST = {
    "integrate_vs_octomap_x": 30,
    "integrate_discrete_vs_octomap_x": 40,
    "integrate_2threads_x": 1.4,
    "integrate_fov_vs_octomap_x": 25,
    "integrate_depth_vs_octomap_x": 30,
    "integrate_robust_whole_x": 0.8,
    "integrate_robust_fov_x": 0.8,
    "memory_vs_octomap_x": 4,
    "lookup_random_vs_octomap_x": 6,
    "lookup_coherent_vs_octomap_x": 20,
    "collide_box_vs_fcl_x": 12,
    "collide_sphere_vs_fcl_x": 30,
    "collide_capsule_vs_fcl_x": 30,
    "collide_mesh_vs_fcl_x": 10,
    "clearance_vs_fcl_x": 100,
    "rpc_points_vs_echo_x": 0.25,
    "mirror_vs_local_x": 0.9,
    "motion_vs_sampled_x": 5,
    "motion_vs_fcl_x": 100,
    "discs_solved_fraction": 1,
    "plan_success_fraction": 0.99,
    "closed_loop_goal_fraction": 0.98,
    "drive_start_frames": 20,
    "prediction_solids_1s_f": 0.9,
    "prediction_whole_solids_1s_f_completed": 0.9,
    "masks_street_solids_1s_f": 0.85,
    "reconstruction_completeness": 0.98,
    "reidentified_fraction": 0.95,
    "reconstruction_registered_accuracy_x": 2,
    "reconstruction_registered_completeness_x": 1,
    "reconstruction_refined_accuracy_x": 2,
    "reconstruction_refined_completeness_x": 1,
    "reconstruction_mended_completeness_x": 1,
    "reconstruction_occupied_precision": 0.97,
    "reconstruction_occupied_recall": 0.97,
    "reconstruction_free_precision": 0.995,
    "reconstruction_free_recall": 0.995,
    # So many that a tenth of them can be told from none.
    "closed_loop_turning_collisions_without": 50,
    "closed_loop_noise_collisions_without": 50,
    "closed_loop_inflation_fewer_x": 10,
    "closed_loop_inflation_goal_ratio": 0.9,
}
AT_MOST = {
    "publish_ms": 1,
    "lookup_fused_cost_x": 1.3,
    "collide_culled_ns_per_object": 30,
    "rpc_unary_vs_empty_x": 1.5,
    "query_p99_while_writing_x": 1.3,
    "delta_mb_per_scan": 3,
    "motion_unresolved_fraction": 0.01,
    "proof_random_free_in_contact": 0,
    "proof_real_free_in_contact": 0,
    "proof_random_witnesses_free": 0,
    "proof_real_witnesses_free": 0,
    "proof_random_unresolved_fraction": 0.01,
    "proof_real_unresolved_fraction": 0.01,
    # A tenth of what OMPL 2.0.2's ST-RRT* takes (113 and 489 ms), and its arrivals.
    "discs_first_40_ms": 11.3,
    "discs_first_60_ms": 48.9,
    "discs_arrival_40_s": 18.22,
    "discs_arrival_60_s": 21.60,
    "plan_touching": 0,
    "plan_over_optimum_x": 1.05,
    "closed_loop_collisions": 0,
    "closed_loop_static_collisions": 0,
    "drive_touching": 0,
    "prediction_van_1s_m": 0.5,
    "prediction_cyclist_1s_m": 0.4,
    "prediction_parked_1s_m": 0.15,
    "masks_van_1s_m": 1.0,
    "masks_cyclist_1s_m": 0.8,
    "masks_worst_size_off_m": 0.5,
    "reconstruction_accuracy_voxels": 0.5,
    "reconstruction_van_size_off_m": 0.2,
    "reconstruction_residual_voxels": 0,
    "reconstruction_mislabelled_accuracy_x": 1.2,
    "reconstruction_residual_voxels_mislabelled": 0,
    "reidentified_wrong": 0,
    "reidentified_wrong_table1": 0,
    "reidentified_wrong_drive": 0,
    "reidentified_wrong_queues": 0,
    "reidentified_wrong_swaps": 0,
    "reidentified_wrong_far_swaps": 0,
}
# So many times another number of the same run.
AT_MOST_TIMES = {
    f"prediction_{what}_oxts_1s_m": (2, f"prediction_{what}_1s_m")
    for what in ("van", "cyclist", "parked")
}

BETWEEN = {
    f"prediction_within{drive}{ahead}": (0.9, 0.98)
    for drive in ("", "_oxts", "_oxts_left", "_av2", "_street", "_table1", "_table1_registered",
                  "_table1_registered_last_motion", "_table1_mended", "_table1_mended_last_motion",
                  "_table1_last_motion", "_lab", "_lab_last_motion")
    for ahead in ("", "_0.5s", "_1s", "_2s", "_3s")
}

# Of recordings that were left out of the fit, by motion model and rest distance.
for setting in ("track_rest", "track", "last_motion_rest", "last_motion"):
    AT_LEAST[f"bound_left_out_{setting}_least_of_classes"] = 0.9
    for ahead in ("0.5s", "1s", "2s", "3s"):
        BETWEEN[f"bound_left_out_{setting}_within_{ahead}"] = (0.93, 0.98)


def row(name, summary, word, bar, meets):
    if name not in summary:
        return f"{name:<36} {'not measured':>12}"
    verdict = "met" if meets(summary[name]) else "NOT MET"
    return f"{name:<36} {summary[name]:>12.3f}   {word:<8} {bar:>5g}   {verdict}"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        summary = json.load(file)
    for name, bar in AT_LEAST.items():
        print(row(name, summary, "at least", bar, lambda value: value >= bar))
    for name, (low, high) in BETWEEN.items():
        print(row(name, summary, f"{low} to", high, lambda value: low <= value <= high))
    at_most = AT_MOST | {
        name: times * summary[other]
        for name, (times, other) in AT_MOST_TIMES.items()
        if other in summary
    }
    for name, bar in at_most.items():
        print(row(name, summary, "at most", bar, lambda value: value <= bar))


main()
