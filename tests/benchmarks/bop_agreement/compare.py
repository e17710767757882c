#!/usr/bin/env python3
"""Compares graspd's pose errors and average recalls with those of bop_toolkit's own functions.

compare.py TOOLKIT ROOT POSE_ERRORS [--split val] [--every 1]

TOOLKIT is a checkout of thodan/bop_toolkit, ROOT a data set in BOP form, POSE_ERRORS the program of this folder's
build. Estimates are true poses of the split, turned by a symmetry, perturbed, doubled, left out or replaced by wrong
ones. Needs numpy, scipy and Pillow (Debian: python3-numpy python3-scipy python3-pil).
"""
import argparse
import collections
import csv
import json
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image
from software_renderer import SoftwareRenderer, load_ply

TOLERANCES = list(np.arange(0.05, 0.51, 0.05))


def read_json(path):
    with open(path) as file:
        return json.load(file)


def turn(random, angle):
    axis = random.normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class DataSet:
    def __init__(self, root, split, every):
        self.root, self.split = root, split
        self.info = {int(k): v for k, v in read_json(f"{root}/models_eval/models_info.json").items()}
        self.points = {o: load_ply(f"{root}/models_eval/obj_{o:06d}.ply")[0] for o in self.info}
        self.symmetries = {o: misc.get_symmetry_transformations(self.info[o], 0.01) for o in self.info}
        self.targets = collections.defaultdict(dict)
        for target in read_json(f"{root}/{split}_targets_bop19.json"):
            self.targets[target["scene_id"], target["im_id"]][target["obj_id"]] = target["inst_count"]
        self.images = sorted(self.targets)[::every]

    def scene_file(self, scene, image, name):
        return read_json(f"{self.root}/{self.split}/{scene:06d}/{name}.json")[str(image)]


def perturbed(data, seed=1):
    """Estimates as (scene, image, object, score, R, t)."""
    random = np.random.default_rng(seed)
    for scene, image in data.images:
        for truth in data.scene_file(scene, image, "scene_gt"):
            obj = truth["obj_id"]
            if obj not in data.targets[scene, image]:
                continue
            diameter = data.info[obj]["diameter"]
            kind = random.random()
            for _ in range(0 if kind < 0.15 else 2 if kind > 0.9 else 1):
                symmetry = data.symmetries[obj][random.integers(len(data.symmetries[obj]))]
                R = np.array(truth["cam_R_m2c"]).reshape(3, 3)
                t = np.array(truth["cam_t_m2c"]) + R @ symmetry["t"].ravel()
                R = R @ symmetry["R"]
                amount = 10 ** random.uniform(-3, -0.4)
                if 0.8 < kind < 0.9:
                    R = turn(random, random.uniform(0.5, np.pi)) @ R
                    t = t + random.normal(size=3) * [0.3 * diameter, 0.3 * diameter, 0.1 * diameter]
                else:
                    R = R @ turn(random, random.normal() * amount)
                    t = t + random.normal(size=3) * amount * diameter * 0.5
                yield scene, image, obj, random.random(), R, t


def write_results(estimates, path):
    with open(path, "w") as out:
        out.write("scene_id,im_id,obj_id,score,R,t,time\n")
        for scene, image, obj, score, R, t in estimates:
            numbers = [" ".join(f"{x:.{digits}f}" for x in values.ravel()) for values, digits in ((R, 9), (t, 7))]
            out.write(f"{scene},{image},{obj},{score:.6f},{numbers[0]},{numbers[1]},1.0\n")


def read_results(path):
    with open(path) as file:
        for row in csv.DictReader(file):
            R, t = (np.array(row[name].split(), float) for name in ("R", "t"))
            yield {**{k: int(row[k]) for k in ("scene_id", "im_id", "obj_id")}, "score": float(row["score"]),
                   "R": R.reshape(3, 3), "t": t.reshape(3, 1)}


def read_our_errors(path):
    """By estimate (line of the result file) and true pose (place in scene_gt.json)."""
    with open(path) as file:
        return {
            (int(row["estimate"]), int(row["truth"])): (
                [float(x) for x in row["vsd"].split()], float(row["mssd"]), float(row["mspd"]))
            for row in csv.DictReader(file)
        }


def toolkit_errors(data, renderer, estimate, truth, depth, K):
    """As eval_calc_errors.py computes them for BOP'19."""
    obj = estimate["obj_id"]
    diameter = data.info[obj]["diameter"]
    R, t = np.array(truth["cam_R_m2c"]).reshape(3, 3), np.array(truth["cam_t_m2c"]).reshape(3, 1)
    vsd, mssd = [1.0] * len(TOLERANCES), float("inf")
    if misc.overlapping_sphere_projections(0.5 * diameter, estimate["t"].squeeze(), t.squeeze()):
        vsd = pose_error.vsd(estimate["R"], estimate["t"], R, t, depth, K, 15, TOLERANCES, True, diameter, renderer,
                             obj, "step")
    arguments = (data.points[obj], data.symmetries[obj])
    if np.linalg.norm(estimate["t"] - t) < diameter:
        mssd = pose_error.mssd(estimate["R"], estimate["t"], R, t, *arguments) / diameter
    mspd = pose_error.mspd(estimate["R"], estimate["t"], R, t, K, *arguments) * 640.0 / renderer.width
    return vsd, mssd, mspd


class Comparison:
    """The largest differences; errors too large to be right at any threshold need not agree beyond that."""

    def __init__(self):
        self.worst = dict.fromkeys(("VSD", "MSSD", "MSPD"), 0.0)
        self.pairs = 0

    def add(self, theirs, ours):
        self.pairs += 1
        self.worst["VSD"] = max(self.worst["VSD"], *(abs(a - b) for a, b in zip(theirs[0], ours[0])))
        for name, a, b, limit in (("MSSD", theirs[1], ours[1], 0.5), ("MSPD", theirs[2], ours[2], 50.0)):
            if not (a >= limit and b >= limit):
                self.worst[name] = max(self.worst[name], abs(a - b))


def most_visible(truths, infos, wanted):
    left, chosen = dict(wanted), [False] * len(truths)
    for i in sorted(range(len(truths)), key=lambda i: infos[i]["visib_fract"], reverse=True):
        if left.get(truths[i]["obj_id"], 0) > 0:
            chosen[i] = True
            left[truths[i]["obj_id"]] -= 1
    return chosen


def compare(data, results, ours):
    """Returns the comparison, the number of estimates, and the toolkit's average recalls."""
    kinds = [("VSD", i) for i in range(len(TOLERANCES))] + [("MSSD", 0), ("MSPD", 0)]
    records = {kind: collections.defaultdict(list) for kind in kinds}
    truths, infos, valid = (collections.defaultdict(dict) for _ in range(3))
    by_target = collections.defaultdict(list)
    for line, estimate in enumerate(results):
        by_target[estimate["scene_id"], estimate["im_id"], estimate["obj_id"]].append((line, estimate))
    comparison, count, renderer = Comparison(), 0, None
    for scene, image in data.images:
        camera = data.scene_file(scene, image, "scene_camera")
        K = np.array(camera["cam_K"]).reshape(3, 3)
        path = f"{data.root}/{data.split}/{scene:06d}/depth/{image:06d}.png"
        depth = np.array(Image.open(path)).astype(np.float32) * camera["depth_scale"]
        if renderer is None or (renderer.height, renderer.width) != depth.shape:
            renderer = SoftwareRenderer(depth.shape[1], depth.shape[0])
            for obj in data.info:
                renderer.add_object(obj, f"{data.root}/models_eval/obj_{obj:06d}.ply")
        truths[scene][image] = data.scene_file(scene, image, "scene_gt")
        infos[scene][image] = data.scene_file(scene, image, "scene_gt_info")
        wanted = data.targets[scene, image]
        valid[scene][image] = most_visible(truths[scene][image], infos[scene][image], wanted)
        for obj, instances in wanted.items():
            best = sorted(by_target[scene, image, obj], key=lambda entry: entry[1]["score"], reverse=True)
            for line, estimate in best[:instances]:
                count += 1
                errors = {kind: {} for kind in kinds}
                visible = {}
                for number, truth in enumerate(truths[scene][image]):
                    if truth["obj_id"] != obj:
                        continue
                    vsd, mssd, mspd = toolkit_errors(data, renderer, estimate, truth, depth, K)
                    comparison.add((vsd, mssd, mspd), ours[line, number])
                    visible[number] = infos[scene][image][number]["visib_fract"]
                    for (name, i), values in errors.items():
                        values[number] = [vsd[i] if name == "VSD" else mssd if name == "MSSD" else mspd]
                for kind in kinds:
                    records[kind][scene].append({"im_id": image, "obj_id": obj, "est_id": line,
                                                 "score": estimate["score"], "errors": errors[kind],
                                                 "gt_visib_fracts": visible})
        print(f"scene {scene}, image {image}", file=sys.stderr)

    def recall(record, threshold):
        matches = []
        for scene in sorted(truths):
            matches += pose_matching.match_poses_scene(scene, truths[scene], infos[scene], valid[scene],
                                                       record[scene], [threshold], -1)
        return score.calc_localization_scores(sorted(truths), sorted(data.info), matches, -1, False)["recall"]

    recalls = {
        "VSD": np.mean([recall(records["VSD", i], th) for i in range(len(TOLERANCES)) for th in TOLERANCES]),
        "MSSD": np.mean([recall(records["MSSD", 0], th) for th in TOLERANCES]),
        "MSPD": np.mean([recall(records["MSPD", 0], th) for th in np.arange(5, 51, 5)]),
    }
    return comparison, count, recalls


def main():
    global misc, pose_error, pose_matching, score
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("toolkit")
    parser.add_argument("root")
    parser.add_argument("pose_errors")
    parser.add_argument("--split", default="val")
    parser.add_argument("--every", type=int, default=1, help="only every so many images; recalls are not compared then")
    options = parser.parse_args()
    sys.path.insert(0, options.toolkit)
    from bop_toolkit_lib import misc, pose_error, pose_matching, score

    data = DataSet(options.root, options.split, options.every)
    with tempfile.TemporaryDirectory() as folder:
        write_results(perturbed(data), f"{folder}/estimates.csv")
        printed = subprocess.run(
            [options.pose_errors, "--bop", options.root, "--split", options.split, "--results",
             f"{folder}/estimates.csv", "--errors", f"{folder}/errors.csv"],
            check=True, capture_output=True, text=True).stdout
        ours = read_our_errors(f"{folder}/errors.csv")
        comparison, count, theirs = compare(data, list(read_results(f"{folder}/estimates.csv")), ours)
    our_recalls = [float(x) for x in printed.splitlines()[-1].split(":")[1].split(",")]

    print(f"{count} estimates, {comparison.pairs} pairs of estimate and true pose; largest difference: "
          + ", ".join(f"{name} {value:.1e}" for name, value in comparison.worst.items()))
    agree = max(comparison.worst.values()) <= 1e-3
    if options.every == 1:
        theirs_list = list(theirs.values())
        rows = zip(("VSD", "MSSD", "MSPD", "AR"), theirs_list + [np.mean(theirs_list)],
                   our_recalls + [np.mean(our_recalls)])
        for name, a, b in rows:
            print(f"average recall {name}: bop_toolkit {a:.5f}, graspd {b:.5f}")
            agree = agree and abs(a - b) <= 1e-3
    print("agree to 1e-3" if agree else "DO NOT AGREE to 1e-3")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
