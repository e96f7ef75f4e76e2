"""The images and tables of each page of docs/methods/: one function per page, called by methods.py. Settings are written
as on the command line; a leading @ abbreviates `trace_screen.`. The prose of a page explains its images and figures."""
import json

import methods_dof
import methods_glass
import methods_motion
import methods_reflections
import methods_shadows
import methods_slices
import methods_world
from methods import Frame, Render, Truth, cached, options

VISIBLE = "--bounces 1 --visible-only"
ALL = "--bounces 1"
# One lobe at a time, lit by direct light only: one bounce, as in the references.
SPECULAR = "diffuse.rays=0 @light=direct "
DIFFUSE = "specular.rays=0 @light=direct "
# Rays that end occluded on screen return black, as in the visible-only reference.
STRICT = SPECULAR + "environment.occluded_weight=0 "

# For images of dark rooms, in stops; linear EXR values do not change.
BRIGHT = "tonemap.exposure=2 "

BALL = (165, 120, 107, 60)  # mirror-hall: the red ball and its reflection in the floor
FAR_MIRROR = (213, 70, 107, 60)  # mirror-hall: the far end of the mirror wall
BOX = (104, 42, 107, 60)  # cubes: the polished box


def render(scene, settings, **more):
    return Render(scene, settings.replace("@", "trace_screen."), **more)


def percent(share):
    return "%.1f %%" % (100 * share)


def traced(frame, lobe):
    """Steps per ray and share of hits, as table cells."""
    rays = frame.rays[lobe]
    return ["%.1f" % rays["steps"], percent(rays["hits"])]


def error(frame, truth, layer):
    return "%.4f" % frame.against(truth, layer)["relative_mse"]


def bias(frame, truth, layer):
    return "%+.1f %%" % (100 * frame.against(truth, layer)["bias"])


LINEAR = STRICT + "@method=linear @max_steps=400 @thickness_mode=step @jitter=false "
TRACED = ["setting", "relative MSE to `exhaustive`", "to visible-only", "steps per ray", "hits"]


def compare_tracers(page, name, scene, base, settings, exhaustive=None):
    """Writes a table of reflection errors against `exhaustive` and against visible-only. Returns the frames by setting."""
    truth = Truth(scene, VISIBLE)
    best = render(scene, exhaustive or STRICT + "@method=exhaustive")
    frames = {s: render(scene, base + s) for s in settings}
    rows = [["`%s`" % s.replace("@", "").strip(), error(f, best, "indirect_specular"), error(f, truth, "indirect_specular")]
            + traced(f, "specular") for s, f in frames.items()]
    rows.append(["`method=exhaustive`", "0", error(best, truth, "indirect_specular")] + traced(best, "specular"))
    page.table(name, TRACED, rows)
    return frames


def steps_too_large(page):
    frames = compare_tracers(page, "steps", "mirror-hall", LINEAR, ["@step=%s" % s for s in ("0.05", "0.1", "0.2", "0.5", "1")])
    for step in ("0.05", "0.2", "0.5", "1"):
        page.picture("step" + step.replace(".", "_"), frames["@step=" + step], BALL)


def jitter(page):
    rows = []
    for rays in (1, 16):
        best = render("mirror-hall", STRICT + "@method=exhaustive specular.rays=%d" % rays)
        for switch in ("false", "true"):
            frame = render("mirror-hall", LINEAR + "@step=0.5 specular.rays=%d @jitter=%s" % (rays, switch))
            page.picture("%s-rays%d" % ("grain" if switch == "true" else "bands", rays), frame, BALL)
            figures = [error(frame, best, "indirect_specular"), error(frame, Truth("mirror-hall", VISIBLE), "indirect_specular")]
            rows.append(["`jitter=%s`, `specular.rays=%d`" % (switch, rays)] + figures + traced(frame, "specular"))
    page.table("jitter", TRACED, rows)


def refinement(page):
    settings = ["@step=0.5", "@step=0.5 @binary_steps=2", "@step=0.5 @binary_steps=4", "@step=0.5 @binary_steps=6",
                "@step=0.5 @interpolate=true", "@step=0.5 @binary_steps=2 @interpolate=true", "@step=0.1"]
    frames = compare_tracers(page, "linear", "mirror-hall", LINEAR, settings)
    for name, setting in (("none", settings[0]), ("binary", settings[3]), ("interpolated", settings[4])):
        page.picture(name, frames[setting], BALL)
    strides = ["@stride=8", "@stride=8 @binary_steps=3", "@stride=8 @interpolate=true", "@stride=1"]
    compare_tracers(page, "dda", "mirror-hall", STRICT + "@method=dda @jitter=false @max_steps=1000 ", strides)


def thickness(page):
    base = SPECULAR + "@method=linear @step=0.1 @max_steps=400 @jitter=false @reject_backfaces=false "
    settings = ["@thickness=%s" % t for t in ("0.01", "0.05", "0.3", "2", "1000")] + ["@thickness=0.01 @thickness_mode=step"]
    truth = Truth("mirror-hall", VISIBLE)
    names = dict(zip(settings, ("holes", None, "fits", None, "smear", "step")))
    rows = []
    for setting in settings + ["@method=hiz @thickness=0.01", "@method=hiz @thickness=0.3", "@method=hiz @thickness=1000"]:
        frame = render("mirror-hall", base + setting)
        if names.get(setting):
            page.picture(names[setting], frame, FAR_MIRROR)
        rows.append(["`%s`" % setting.replace("@", ""), error(frame, truth, "indirect_specular"),
                     bias(frame, truth, "indirect_specular")] + traced(frame, "specular"))
    page.picture("truth", truth, FAR_MIRROR)
    page.table("thickness", ["setting", "relative MSE to visible-only", "bias", "steps per ray", "hits"], rows)


def leaking(page):
    settings = ["@thickness=1000 @reject_backfaces=false environment.occluded_weight=1",
                "@thickness=0.3 @reject_backfaces=false environment.occluded_weight=1",
                "@thickness=0.3 @reject_backfaces=true environment.occluded_weight=1",
                "@thickness=0.3 @reject_backfaces=true environment.occluded_weight=0.5",
                "@thickness=0.3 @reject_backfaces=true environment.occluded_weight=0"]
    rows = []
    for scene in ("cave", "cornell", "cubes"):
        truth, visible = Truth(scene, ALL), Truth(scene, VISIBLE)
        for i, setting in enumerate(settings if scene == "cubes" else settings[:3]):
            frame = render(scene, DIFFUSE + "diffuse.rays=32 " + setting)
            short = setting if scene == "cubes" else setting.rsplit(" ", 1)[0]
            rows.append([scene, "`%s`" % short.replace("@", "").replace("environment.", "")]
                        + [f(frame, t, "indirect_diffuse") for t in (truth, visible) for f in (error, bias)])
            if scene == "cave":
                page.picture(("leak", "thin", "facing")[i], frame, (20, 55, 107, 60))
        if scene == "cave":
            page.picture("truth", truth, (20, 55, 107, 60))
    page.table("leaking", ["scene", "setting", "relative MSE to the reference", "bias", "to visible-only", "bias"], rows)


def adaptive_steps(page):
    settings = ["@method=linear @step=0.05 @max_steps=400 @thickness_mode=step @jitter=false",
                "@method=halving @step=0.8 @max_steps=64 @jitter=false", "@method=halving @step=0.3 @max_steps=64 @jitter=false",
                "@method=fixed_point @step=1 @max_steps=16", "@method=fixed_point @step=0.3 @max_steps=16", "@method=hiz", "@method=hiz @max_steps=4096"]
    names = ("linear", "halving", None, None, "fixed-point", None, "hiz")
    compare_tracers(page, "cubes", "cubes", STRICT, settings)
    compare_tracers(page, "mirror-hall", "mirror-hall", STRICT, settings)
    for name, setting in zip(names, settings):
        if name:
            page.picture(name, render("mirror-hall", SPECULAR + setting), FAR_MIRROR)


def count_methods(page, scene):
    base = "@light=direct diffuse.rays=1 specular.rays=1 "
    most = "@max_steps=4096 "
    big = {"size": "1280x720"}
    whole = {m: render(scene, base + "@method=%s " % m + most, **big) for m in ("exhaustive", "hiz", "dda")}
    for method, settings in (("linear", "@step=0.15 @max_steps=128 @thickness_mode=step"),
                             ("halving", "@step=0.8 @max_steps=128"), ("fixed_point", "@step=1 @max_steps=128")):
        whole["%s %s" % (method, settings)] = render(scene, base + "@method=%s %s" % (method, settings), **big)
    rows = [["`%s`" % m.replace("@", "")] + traced(f, "diffuse") + traced(f, "specular") for m, f in whole.items()]
    page.table(scene + "-methods", ["method", "diffuse: steps per ray", "hits", "reflections: steps per ray", "hits"], rows)
    rows = []
    for cap in (16, 32, 64, 128):
        cells = []
        for method in ("hiz", "dda"):
            frame = render(scene, base + "@method=%s @max_steps=%d" % (method, cap), **big)
            for lobe in ("diffuse", "specular"):
                cells.append(percent(frame.rays[lobe]["hits"] / whole[method].rays[lobe]["hits"]))
        rows.append([str(cap)] + cells)
    page.table(scene + "-caps", ["`max_steps`", "`hiz`: diffuse", "reflections", "`dda`: diffuse", "reflections"], rows)


def hierarchical_depth(page):
    for method in ("exhaustive", "dda", "hiz"):
        frame = render("mirror-hall", SPECULAR + "@max_steps=4096 @method=" + method, show="specular_steps")
        page.picture("steps-" + method, frame)
    for method in ("dda", "hiz"):
        page.picture("cap64-" + method, render("mirror-hall", SPECULAR + "@max_steps=64 @method=" + method, size="640x360"),
                     (320, 120, 320, 180), 1)
    count_methods(page, "cubes")
    count_methods(page, "mirror-hall")


def uniform_and_cosine(page):
    truth, rows = Truth("cornell", ALL, BRIGHT), []
    for rays in (1, 4, 16, 64):
        for kind in ("uniform", "cosine"):
            frame = render("cornell", DIFFUSE + BRIGHT + "diffuse.rays=%d diffuse.distribution=%s" % (rays, kind))
            rows.append(["`%s`, `diffuse.rays=%d`" % (kind, rays), error(frame, truth, "indirect_diffuse"),
                         bias(frame, truth, "indirect_diffuse")] + traced(frame, "diffuse"))
            if rays == 16:
                page.picture(kind, frame, (90, 50, 107, 60))
    page.picture("truth", truth, (90, 50, 107, 60))
    page.table("distribution", ["setting", "relative MSE to the reference", "bias", "steps per ray", "hits"], rows)


def mirror_to_matt(page):
    truth, rows = Truth("gloss", ALL), []
    window = (72, 42, 107, 60)
    settings = ["specular.rays=%d" % n for n in (1, 4, 16, 64)] + ["specular.max_roughness=0.3"]
    settings += ["specular.rough_fallback=mips specular.max_roughness=%s" % r for r in ("0.5", "0.3", "0.1")]
    settings.append(settings[-1] + " specular.rays=16")
    names = ("rays1", None, "rays16", None, "max0_3", None, "mips", None, None)
    for name, setting in zip(names, settings):
        frame = render("gloss", SPECULAR + setting)
        rows.append(["`%s`" % setting, error(frame, truth, "indirect_specular"), bias(frame, truth, "indirect_specular")]
                    + traced(frame, "specular"))
        if name:
            page.picture(name, frame, window)
    page.picture("truth", truth, window)
    page.table("roughness", ["setting", "relative MSE to the reference", "bias", "steps per ray", "hits"], rows)


def unknown(page):
    rows = []
    views = (("tops", "mirror-hall", "tops-off-screen", ["", "@edge_fade=0.2"]),
             ("toward", "mirror-hall", "into-the-mirror", ["", "@camera_fade=0.5", "@camera_fade=1"]),
             ("hidden", "cubes", None, [""]))
    for name, scene, view, settings in views:
        truth, visible = Truth(scene, ALL, view=view), Truth(scene, VISIBLE, view=view)
        window, zoom = (BOX, 3) if name == "hidden" else ((0, 0, 320, 180), 1)
        for setting in settings:
            frame = render(scene, SPECULAR + setting, view=view)
            fade = setting.strip("@").replace("=", "").replace(".", "_")
            if setting != "@camera_fade=0.5":
                page.picture("-".join(filter(None, (name, fade))), frame, window, zoom)
            figures = [f(frame, t, "indirect_specular") for t in (truth, visible) for f in (error, bias)]
            rows.append([name, "`%s`" % (setting.strip("@") or "plain")] + figures)
        page.picture(name + "-truth", truth, window, zoom)
        page.picture(name + "-visible", visible, window, zoom)
        rows.append([name, "*visible-only itself*"] + [f(visible, truth, "indirect_specular") for f in (error, bias)] + ["", ""])
    page.table("unknown", ["view", "setting", "relative MSE to the reference", "bias", "to visible-only", "bias"], rows)


def second_layer(page):
    rows = []
    settings = ["@thickness=0.05", "@thickness=0.3", "@thickness=1000", "@thickness_mode=second_layer"]
    names = (None, "constant", "endless", "second")
    tests = (("cubes", "specular", SPECULAR), ("gloss", "diffuse", DIFFUSE + "diffuse.rays=32 "),
             ("cornell", "diffuse", DIFFUSE + "diffuse.rays=32 "), ("cave", "diffuse", DIFFUSE + "diffuse.rays=32 "))
    for scene, lobe, base in tests:
        truth = Truth(scene, VISIBLE)
        for name, setting in zip(names, settings):
            frame = render(scene, base + setting)
            layer = "indirect_" + lobe
            rows.append([scene + ", " + ("reflections" if lobe == "specular" else lobe), "`%s`" % setting.strip("@"),
                         error(frame, truth, layer), bias(frame, truth, layer)] + traced(frame, lobe))
            if scene in ("cubes", "cave") and name:
                page.picture(scene + "-" + name, frame, BOX if scene == "cubes" else (20, 55, 107, 60))
        if scene in ("cubes", "cave"):
            page.picture(scene + "-visible", truth, BOX if scene == "cubes" else (20, 55, 107, 60))
    page.table("second-layer", ["scene", "setting", "relative MSE to visible-only", "bias", "steps per ray", "hits"], rows)


def depth_precision(page):
    truth, rows = Truth("cubes", ALL, view="near"), []
    for buffer in ("standard16", "standard24", "reversed_float"):
        setting = "depth.format=%s @light=direct diffuse.rays=16" % buffer
        frame = render("cubes", setting, view="near")
        page.picture(buffer, frame)
        rows.append(["`%s`" % buffer] + [error(frame, truth, x) for x in ("direct", "indirect_diffuse", "indirect_specular")]
                    + traced(frame, "specular"))
    page.table("depth", ["`depth.format`", "relative MSE to the reference: direct light", "indirect diffuse", "reflections",
                         "steps per reflection ray", "hits"], rows)


def noise(page):
    rows = []
    for scene in ("cornell", "gloss"):
        layer, base, setting = (("indirect_diffuse", DIFFUSE + BRIGHT, "diffuse") if scene == "cornell"
                                else ("indirect_specular", SPECULAR, "specular"))
        truth = Truth(scene, ALL)
        for rays in (1, 4, 16, 64):
            for kind in ("white", "blue"):
                frame = render(scene, base + "%s.rays=%d %s.noise=%s" % (setting, rays, setting, kind))
                figures = frame.against(truth, layer)
                rows.append([scene, "`%s.noise=%s`, `%s.rays=%d`" % (setting, kind, setting, rays),
                             "%.4f" % figures["relative_mse"], "%.3f" % figures["flip"]])
                if rays == (16 if scene == "cornell" else 4):
                    page.picture("%s-%s" % (scene, kind), frame, (90, 50, 107, 60) if scene == "cornell" else (110, 42, 107, 60))
    page.table("noise", ["scene", "setting", "relative MSE to the reference", "FLIP"], rows)


def games202(page):
    truth = Truth("cubes", VISIBLE, "materials.lambert_only=true tonemap.curve=gamma22")
    cases = [("games202_original", "", "original"), ("games202", "", "right"), ("games202", "diffuse.rays=32", "rays32"),
             ("games202", "@thickness=1000", None), ("games202_linear", "", "linear60"), ("games202_linear", "@max_steps=150", None),
             ("games202_linear", "@thickness=1000", None), ("games202_linear", "@max_steps=150 @thickness=1000", None)]
    rows = []
    for preset, setting, name in cases:
        frame = render("cubes", setting, preset=preset)
        if name:
            page.picture(name, frame, (92, 20, 160, 90), 2)
        rows.append(["`%s`%s" % (preset, " `%s`" % setting.replace("@", "") if setting else "")]
                    + [error(frame, truth, "indirect_diffuse"), bias(frame, truth, "indirect_diffuse"), error(frame, truth, "final")]
                    + traced(frame, "diffuse"))
    page.picture("visible", truth, (92, 20, 160, 90), 2)
    page.table("errors", ["preset", "relative MSE to visible-only: indirect light", "bias", "final image", "steps per ray", "hits"],
               rows)


class After(Frame):
    """The image after a number of frames at rest, and the time of the last ones."""

    def __init__(self, scene, settings, frames, size):
        self.arguments = options(scene, settings, None, size, "balanced") + ["--frames", str(frames)]
        self.png, self.exr, timings = cached("render", self.arguments, [".png", ".exr", ".json"])
        self.ms = json.load(open(timings))["frame_ms"]


def temporal_upscaling(page):
    scene, size, rods = "colonnade", "640x360", (150, 160, 107, 60)
    truth = Truth(scene, "", size=size)
    rows = []
    for scale in ("1", "0.667", "0.5", "0.333"):
        row = ["`temporal.scale=%s`" % scale]
        for frames in (1, 8, 32, 128):
            frame = After(scene, "temporal.scale=" + scale, frames, size)
            figures = frame.against(truth)
            row.append("%.4f / %.3f" % (figures["relative_mse"], figures["flip"]))
            if scale in ("1", "0.5") and frames in (1, 32):
                page.picture("scale%s-frame%d" % (scale.replace(".", "_"), frames), frame, rods)
        rows.append(row + ["%.0f" % frame.ms])
    page.picture("truth", truth, rods)
    page.table("scales", ["setting"] + ["frame %d" % n for n in (1, 8, 32, 128)] + ["ms"], rows)


PAGES = {"steps-too-large": steps_too_large, "jitter": jitter, "refinement": refinement, "thickness": thickness,
         "leaking": leaking, "adaptive-steps": adaptive_steps, "hierarchical-depth": hierarchical_depth,
         "uniform-and-cosine": uniform_and_cosine, "mirror-to-matt": mirror_to_matt, "unknown": unknown,
         "second-layer": second_layer, "depth-precision": depth_precision, "noise": noise, "games202": games202,
         "temporal-upscaling": temporal_upscaling,
         **methods_shadows.PAGES, **methods_reflections.PAGES, **methods_slices.PAGES, **methods_dof.PAGES, **methods_motion.PAGES, **methods_glass.PAGES,
         **methods_world.PAGES}
