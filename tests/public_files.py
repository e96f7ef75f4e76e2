#!/usr/bin/env python3
"""Renders every glTF file below a folder; called by public_files.sh. Writes OUT/table.md, OUT/table.json and
OUT/sheet.png, and keeps the pictures, so that a second run renders only what is missing."""
import argparse
import json
import pathlib
import shutil
import subprocess
import time

REFLET = pathlib.Path(__file__).resolve().parent.parent / "build/bin/reflet"
LOOKED_INTO = {"balanced": 0.05, "hybrid": 0.02}  # relative MSE above which a row is marked


def parsed():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", dest="out", type=pathlib.Path, default=pathlib.Path("out/public-files"))
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--spp", default="256", help="samples per pixel of the reference")
    parser.add_argument("--frames", default="32", help="of each preset")
    parser.add_argument("--presets", default="fast,balanced,quality,hybrid")
    parser.add_argument("--match", default="", help="only files whose path has this text")
    parser.add_argument("--limit", type=float, default=300.0, help="seconds for each picture")
    parser.add_argument("--program", type=pathlib.Path, default=REFLET)
    return parser.parse_args()


def run(arguments, limit):
    """Exit status (124: out of time), seconds, the standard error's lines."""
    start = time.monotonic()
    try:
        done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=limit)
        return done.returncode, time.monotonic() - start, done.stderr.strip().splitlines()
    except subprocess.TimeoutExpired:
        return 124, limit, [f"out of time after {limit:g} s"]


def luminance(picture):
    """Mean display luminance of a PNG, 0 to 1; None without ImageMagick."""
    if shutil.which("convert") is None:
        return None
    done = subprocess.run(["convert", str(picture), "-colorspace", "Gray", "-format", "%[fx:mean]", "info:"],
                          capture_output=True, text=True)
    return float(done.stdout) if done.returncode == 0 else None


def drawn(options, file, base, command):
    """Renders to BASE.exr and BASE.png unless they are there."""
    record = pathlib.Path(f"{base}.json")  # not with_suffix: the base ends with a preset's name
    if record.exists():
        return json.loads(record.read_text())
    status, seconds, lines = run([options.program, *command, file, "--size", options.size, "-o", f"{base}.exr", "-o",
                                  f"{base}.png"], options.limit)
    result = {"status": status, "seconds": round(seconds, 2), "messages": [l for l in lines if "%" not in l]}
    if status == 0:
        result["luminance"] = luminance(f"{base}.png")
    record.write_text(json.dumps(result))
    return result


def error(options, picture, truth):
    done = subprocess.run([str(options.program), "compare", f"{picture}.exr", f"{truth}.exr", "--json"],
                          capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def row(options, file):
    base = options.out / "pictures" / str(file.relative_to(options.folder)).replace("/", "__")
    base.parent.mkdir(parents=True, exist_ok=True)
    truth = pathlib.Path(f"{base}.reference")
    entry = {"file": str(file.relative_to(options.folder)),
             "reference": drawn(options, file, truth, ["reference", "--spp", options.spp]), "presets": {}}
    for preset in options.presets.split(","):
        picture = pathlib.Path(f"{base}.{preset}")
        result = drawn(options, file, picture, ["render", "--preset", preset, "--frames", options.frames])
        if result["status"] == 0 and entry["reference"]["status"] == 0:
            result["error"] = error(options, picture, truth)
        entry["presets"][preset] = result
    return entry


def cell(preset, result):
    if result["status"] != 0:
        return f"exit {result['status']}"
    if not result.get("error"):
        return f"{result['seconds']:.1f} s"
    relative = result["error"]["relative_mse"]
    mark = " !" if relative > LOOKED_INTO.get(preset, float("inf")) else ""
    return f"{relative:.4f} {100 * result['error'].get('bias', 0.0):+.1f} %{mark}"


def table(options, rows):
    presets = options.presets.split(",")
    lines = [f"| file | status | seconds | luminance | {' | '.join(presets)} |", "|---|--:|--:|--:" + "|--:" * len(presets) + "|"]
    for entry in rows:
        reference = entry["reference"]
        first = entry["presets"][presets[0]]
        seen = reference.get("luminance")
        shown = "" if seen is None else f"{seen:.2f}"
        lines.append(f"| {entry['file']} | {reference['status']} | {first['seconds']:.1f} | {shown} | " +
                     " | ".join(cell(p, entry["presets"][p]) for p in presets) + " |")
    return "\n".join(lines) + "\n"


def sheet(options):
    """A row for each file: the reference, then the presets."""
    pictures = []
    for reference in sorted((options.out / "pictures").glob("*.reference.png")):
        name = str(reference).removesuffix(".reference.png")
        row_of = [str(reference)] + [f"{name}.{p}.png" for p in options.presets.split(",")]
        pictures += [p if pathlib.Path(p).exists() else "null:" for p in row_of]
    columns = 1 + len(options.presets.split(","))
    if pictures and shutil.which("montage"):
        subprocess.run(["montage", *pictures, "-tile", f"{columns}x", "-geometry", "+2+2", str(options.out / "sheet.png")],
                       check=False)


def main():
    options = parsed()
    files = sorted(f for f in options.folder.rglob("*") if f.suffix in (".gltf", ".glb") and options.match in str(f))
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for file in files:
        rows.append(row(options, file))
        print(table(options, rows[-1:]).splitlines()[-1], flush=True)
    (options.out / "table.json").write_text(json.dumps(rows, indent=1))
    (options.out / "table.md").write_text(table(options, rows))
    sheet(options)


main()
