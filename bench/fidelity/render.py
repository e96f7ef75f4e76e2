#!/usr/bin/env python3
"""A renderer of glTF-Render-Fidelity-Generator: draws one of its scenarios with reflet.

    render.py [--preset NAME | --spp N] [--curve NAME] [--program FILE] JSON

The generator adds JSON: { "scenario": {...}, "outputFile": "..." }. Paths in it are relative to its packages folder, or
else to the current one. Without --preset the path tracer draws. README.md says what goes into its config.json.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile


def found(path, output):
    """The file that a scenario names: from the generator's packages folder, its root, or here."""
    packages = output.split("render-fidelity-tools")[0] if "render-fidelity-tools" in output else ""
    plain = path
    while plain.startswith("../"):
        plain = plain[3:]
    for candidate in (path, os.path.join(packages, path), plain, os.path.join("test", path)):
        if os.path.exists(candidate):
            return candidate
    sys.exit(f"render.py: {path}: no such file; run this in the generator's folder")


def view_of(scenario, lighting):
    """Camera and light as a view file of reflet."""
    target = [scenario["target"][axis] for axis in "xyz"]
    orbit = scenario["orbit"]
    theta, phi = math.radians(orbit["theta"]), math.radians(orbit["phi"])
    away = [math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta)]
    radius = max(orbit["radius"], 1e-4)  # 0: from inside, looking the same way
    return {
        "camera": {
            "position": [t + radius * a for t, a in zip(target, away)],
            "target": target,
            "fov_y": scenario["verticalFoV"],
        },
        # The generator's renderers have the image's centre at +X, reflet has it at -Z.
        "environment": {"image": os.path.abspath(lighting), "intensity": 1, "rotation": -90},
        "background": "environment" if scenario["renderSkybox"] else "transparent",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", help="a preset of the renderer, such as hybrid; else the path tracer draws")
    parser.add_argument("--spp", default="256", help="samples of each pixel of the path tracer")
    parser.add_argument("--curve", default="neutral", help="tone map: neutral, aces or agx")
    parser.add_argument("--program", default="reflet", help="the program")
    parser.add_argument("config", metavar="JSON", help="what the generator passes")
    given = parser.parse_args()
    config = json.loads(given.config)
    scenario, output = config["scenario"], config["outputFile"]
    size = scenario["dimensions"]
    with tempfile.TemporaryDirectory() as folder:
        view = os.path.join(folder, "view.json")
        with open(view, "w", encoding="utf-8") as file:
            json.dump(view_of(scenario, found(scenario["lighting"], output)), file)
        how = ["render", "--preset", given.preset] if given.preset else ["reference", "--spp", given.spp]
        command = [given.program, how[0], found(scenario["model"], output), *how[1:], "--view-file", view]
        # Goldens have two pixels for each of a scenario's.
        command += ["--size", f"{2 * size['width']}x{2 * size['height']}", "-o", output, "--quiet"]
        command += ["--set", f"tonemap.curve={given.curve}", "--set", "tonemap.auto_exposure=off"]
        command += ["--animation", "none"]  # goldens show the rest pose
        sys.exit(subprocess.run(command, check=False).returncode)


if __name__ == "__main__":
    main()
