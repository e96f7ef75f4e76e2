"""The images and tables of the pages ambient-occlusion and slices of docs/methods/, called by methods.py."""
import json

from methods import Frame, Truth, cached, options

SCENES = ("cubes", "tilted-cube", "cornell", "cave", "gloss", "colonnade", "mirror-hall", "lamps", "moving")
ROUNDS = 2


class Rest(Frame):
    """The last of some frames at rest, with the denoiser of the preset balanced, and its passes' times [ms]."""

    def __init__(self, scene, settings, frames=32, size="320x180", aov="", show=None, view=None):
        self.arguments = options(scene, "temporal.enabled=false " + settings, view, size, "balanced") + ["--frames", str(frames)]
        self.arguments += ["--show", show] if show else []
        more = ["--aov", aov] if aov else []
        self.png, self.exr, timings = cached("render", self.arguments + more, [".png", ".exr", ".json"])
        self.passes = json.load(open(timings))["passes"]


AO = "diffuse.rays=0 specular.rays=0 ao.slices=3 "
BARS = ((240, 60, 80, 60), 4)
BOARDS = ((50, 10, 160, 90), 2)


def ao(scene, settings):
    return Rest(scene, AO + settings, aov="ambient_occlusion", show="ambient_occlusion")


def ao_truth(scene, visible):
    kind = "--layers ambient_occlusion --ao-radius 1 --filter center" + (" --visible-only" if visible else "")
    return Truth(scene, kind, spp=1024)


def mse(frame, truth, layer="ambient_occlusion"):
    return "%.4f" % frame.against(truth, layer)["relative_mse"]


def bias(frame, truth, layer="ambient_occlusion"):
    return "%+.1f %%" % (100 * frame.against(truth, layer)["bias"])


def ambient_occlusion(page):
    rows = []
    for scene in SCENES:
        truth, visible = ao_truth(scene, False), ao_truth(scene, True)
        frames = [ao(scene, "ao.method=%s" % m) for m in ("horizon", "bitmask")]
        page.picture(scene, frames[1])
        page.picture(scene + "-truth", truth)
        rows.append([scene] + [mse(f, t) for t in (visible, truth) for f in frames]
                    + [bias(f, truth) for f in frames])
    page.table("scenes", ["scene", "horizon, to visible-only", "bitmask", "horizon, to the reference", "bitmask",
                          "horizon, bias", "bitmask, bias"], rows)

    rows = []
    for scene, window in (("colonnade", BARS), ("gloss", BOARDS)):
        truth, visible = ao_truth(scene, False), ao_truth(scene, True)
        for name, setting in (("horizon", "ao.method=horizon"), (None, "ao.method=bitmask ao.thickness=0.05"),
                              ("bitmask", "ao.method=bitmask"), (None, "ao.method=bitmask ao.thickness=1"),
                              ("growing", "ao.method=bitmask ao.thickness_mode=growing"),
                              (None, "ao.method=bitmask ao.thickness_mode=second_layer")):
            frame = ao(scene, setting)
            if name == "horizon" or name == ("growing" if scene == "colonnade" else "bitmask"):
                page.picture("%s-%s" % (scene, name), frame, *window)
            rows.append([scene, "`%s`" % setting.replace("ao.", ""), mse(frame, visible), mse(frame, truth), bias(frame, truth)])
        page.picture("%s-detail-visible" % scene, visible, *window)
        page.picture("%s-detail-truth" % scene, truth, *window)
    page.table("thickness", ["scene", "setting", "relative MSE to visible-only", "to the reference", "bias"], rows)

    rows = []
    for slices in (1, 2, 3):
        for downsample in (1, 2, 4):
            row = ["`ao.slices=%d`, `ao.downsample=%d`" % (slices, downsample)]
            for denoise in ("false", "true"):
                setting = "ao.method=bitmask ao.slices=%d ao.downsample=%d denoise.enabled=%s" % (slices, downsample, denoise)
                row.append(mse(ao("cubes", setting), ao_truth("cubes", True)))
                row.append(mse(ao("cave", setting), ao_truth("cave", True)))
                row.append("%.0f" % milliseconds("cave", AO + setting, "ao."))
            rows.append(row)
    page.table("cost", ["setting", "cubes", "cave", "ms", "denoised: cubes", "cave", "ms"], rows)


def milliseconds(scene, settings, prefix, only=None):
    """Time of these passes at 1280x720: the lowest of some medians."""
    best = []
    for turn in range(ROUNDS):
        passes = Rest(scene, settings, frames=6 + turn, size="1280x720").passes
        best.append(sum(ms for name, ms in passes.items()
                        if name.startswith(prefix) and (not only or name.split(".")[1] in only)))
    return min(best)


GI = ("specular.rays=0 trace_screen.light=direct probes.enabled=false planar.enabled=false "
      "environment.occluded_weight=0 ")
WINDOW = ((40, 22, 240, 135), 1)
# What differs between the methods; denoising and upsampling are the same.
TRACE = ("generate_rays", "trace_screen", "trace_at_once", "pack_slices", "start_slices", "slices_at_once", "trace_slices")


def gi_truth(scene):
    return Truth(scene, "--bounces 1 --visible-only --filter center", spp=1024)


def gi(scene, settings):
    return Rest(scene, GI + settings, aov="indirect_diffuse")


def slices(page):
    names = {"rays": "diffuse.method=rays diffuse.rays=2", "slices": "diffuse.method=slices diffuse.rays=2"}
    for scene in ("cornell", "cave"):
        for name, setting in names.items():
            page.picture("%s-%s" % (scene, name), gi(scene, setting), *WINDOW)
        page.picture("%s-truth" % scene, gi_truth(scene), *WINDOW)

    rows = []
    for scene in ("cornell", "cave", "cubes", "gloss"):
        visible = gi_truth(scene)
        for method, counts in (("rays", (1, 2, 4)), ("slices", (1, 2, 3))):
            for count in counts:
                setting = "diffuse.method=%s diffuse.rays=%d " % (method, count)
                full, half = gi(scene, setting + "diffuse.downsample=1"), gi(scene, setting + "diffuse.downsample=2")
                layer = "indirect_diffuse"
                rows.append([scene, "%s, %d" % (method, count), mse(full, visible, layer), mse(half, visible, layer),
                             bias(half, visible, layer),
                             "%.0f" % milliseconds(scene, GI + setting + "diffuse.downsample=2", "diffuse.", TRACE)])
    page.table("front", ["scene", "method and samples", "full resolution", "half resolution", "bias", "ms"], rows)

    rows = []
    for scene in ("cornell", "cave"):
        visible = gi_truth(scene)
        for thickness in ("0.05", "0.3", "1", "1000"):
            setting = "diffuse.method=%s diffuse.rays=2 diffuse.downsample=1 trace_screen.thickness=%s"
            row = [scene, "`thickness=%s`" % thickness]
            for method in ("rays", "slices"):
                frame = gi(scene, setting % (method, thickness))
                row += [mse(frame, visible, "indirect_diffuse"), bias(frame, visible, "indirect_diffuse")]
            rows.append(row)
    page.table("thickness", ["scene", "setting", "rays", "bias", "slices", "bias"], rows)

    rows = []
    for steps in (4, 6, 8, 12, 16):
        row = ["`diffuse.slice_steps=%d`" % steps]
        for scene in ("cornell", "cave", "cubes", "gloss"):
            frame = gi(scene, "diffuse.method=slices diffuse.rays=2 diffuse.downsample=1 diffuse.slice_steps=%d" % steps)
            row.append(mse(frame, gi_truth(scene), "indirect_diffuse"))
        setting = "diffuse.method=slices diffuse.rays=2 diffuse.downsample=2 diffuse.slice_steps=%d" % steps
        rows.append(row + ["%.0f" % milliseconds("cave", GI + setting, "diffuse.", TRACE)])
    page.table("steps", ["setting", "cornell", "cave", "cubes", "gloss", "ms, cave"], rows)


PAGES = {"ambient-occlusion": ambient_occlusion, "slices": slices}
