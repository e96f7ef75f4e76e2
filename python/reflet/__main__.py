"""python3 -m reflet check DIR: reads every frame of a data set, and tests it against its checksums and the contract."""

import sys

from . import check, open_dataset

LIMITS = {"finite": 0, "sum": 2e-3, "noisy_sum": 2e-3, "motion": 0.02, "normal": 2e-3}  # half floats have 11 bits


def main(arguments):
    if len(arguments) != 2 or arguments[0] != "check":
        print("usage: python3 -m reflet check DIR", file=sys.stderr)
        return 2
    data = open_dataset(arguments[1])
    worst, bad = {}, 0
    for frame in data:
        damage = frame.damage()
        errors = {} if damage else {name: value for name, value in check(frame).items() if value is not None}
        broken = [f"{name} is {value:.3g}" for name, value in errors.items() if value > LIMITS[name]]
        if damage or broken:
            bad += 1
            print(f"{frame.name}: {damage or ', '.join(broken)}")
        worst = {name: max(value, worst.get(name, 0)) for name, value in {**dict.fromkeys(worst, 0), **errors}.items()}
    print(f"{len(data)} frames, {data.missing} missing, {bad} bad; largest errors: "
          + ", ".join(f"{name} {value:.3g}" for name, value in worst.items()))
    return 1 if bad or data.missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
