"""The images and tables of the shadow pages of docs/methods/: one function per page, called by methods.py. Settings are
written as on the command line; a leading @ abbreviates `shadow.`. The prose of a page explains its images and figures."""
import base64
import json
import struct

from methods import CACHE, Render, Truth, cached, options

# Direct light only, sampled at pixel centres as the renderer does.
TRUTH = "--bounces 0 --filter center"
DIRECT = "diffuse.rays=0 specular.rays=0 "
SUNS = (("0.53°", None), ("5°", "sun-5-degrees"))
FIGURES = ["relative MSE to the reference", "FLIP"]

BARS = (96, 104, 107, 60)  # colonnade: shadows of the bars at 1 m and 2 m
PANEL = (20, 112, 107, 60)  # colonnade: the pierced panel's shadow
FOOT = (0, 80, 107, 60)  # colonnade, camera contact: the foot of the nearest column
UNDER_PANEL = (128, 95, 107, 60)  # the same: between the panel, 10 cm above the ground, and its shadow
BLUE_CUBE = (200, 90, 53, 30)  # cubes


class Shadows(Render):
    """A frame of direct light only. more: further command-line options."""

    def __init__(self, scene, settings="", view=None, more="", show=None):
        settings = DIRECT + settings.replace("@", "shadow.")
        self.arguments = options(scene, settings, view, "320x180", "plain") + more.split()
        self.arguments += ["--show", show] if show else []
        if show:
            self.png, = cached("render", self.arguments, [".png"])
        else:
            self.png, self.exr = cached("render", self.arguments + ["--aov", "sun_visibility"], [".png", ".exr"])


def errors(frame, truth):
    """Relative MSE and FLIP of the sun's visibility, as table cells."""
    figures = frame.against(truth, "sun_visibility")
    return ["%.4f" % figures["relative_mse"], "%.4f" % figures["flip"]]


def visibility(page, name, frame, window):
    page.picture(name, frame, window, layer="sun_visibility")


def short(settings):
    return "`%s`" % settings.replace("@", "").strip()


def soft_shadows(page):
    filters = {"hard": "@filter=hard", "pcf": "@filter=pcf", "wide": "@filter=pcf @radius=0.2", "pcss": "@filter=pcss"}
    rows = []
    for scene in ("colonnade", "cubes"):
        for sun, view in SUNS:
            truth = Truth(scene, TRUTH, view=view)
            for name, setting in filters.items():
                frame = Shadows(scene, setting, view)
                rows.append(["%s, sun of %s" % (scene, sun), short(setting)] + errors(frame, truth))
                if scene == "colonnade":
                    visibility(page, "%s-%s" % (name, "small" if view is None else "large"), frame, BARS)
            if scene == "colonnade":
                visibility(page, "truth-%s" % ("small" if view is None else "large"), truth, BARS)
    page.table("filters", ["scene", "setting"] + FIGURES, rows)
    page.picture("whole", Shadows("colonnade", "", SUNS[1][1]))
    page.picture("whole-truth", Truth("colonnade", TRUTH, view=SUNS[1][1]))
    for show in ("penumbra_width", "blocker_distance"):
        page.picture(show.replace("_", "-"), Shadows("colonnade", "", SUNS[1][1], show=show))


def sampled(samples, pattern="", denoise="false", frames=1):
    """Settings and options for this many samples in the blocker search and in the filter."""
    settings = "@samples=%d @blocker_samples=%d @denoise=%s %s" % (samples, samples, denoise, pattern)
    return settings.strip(), "--frames %d" % frames if frames > 1 else ""


def shadow_noise(page):
    patterns = {"vogel": "", "rings": "@pattern=rings", "mirrored": "@pattern=rings @mirrored=true"}
    truths = [Truth("colonnade", TRUTH, view=view) for _, view in SUNS]

    def row(name, samples, pattern="", denoise="false", frames=1):
        settings, more = sampled(samples, pattern, denoise, frames)
        both = [Shadows("colonnade", settings, view, more) for _, view in SUNS]
        if name:
            visibility(page, name, both[1], PANEL)
        return [cell for frame, truth in zip(both, truths) for cell in errors(frame, truth)]

    head = ["relative MSE, sun of 0.53°", "FLIP", "relative MSE, sun of 5°", "FLIP"]
    rows = []
    for samples in (4, 8, 16, 64):
        for name, pattern in patterns.items():
            picture = "%s%d" % (name, samples) if samples in (4, 16) else None
            rows.append([str(samples), short(pattern or "@pattern=vogel")] + row(picture, samples, pattern))
    page.table("samples", ["samples", "setting"] + head, rows)
    rows = []
    for samples in (4, 8, 16, 64):
        rows.append([str(samples), "off"] + row(None, samples))
        for frames in (1, 8, 32):
            picture = "clean%d-frames%d" % (samples, frames) if samples == 4 else None
            rows.append([str(samples), "frame %d" % frames] + row(picture, samples, "", "true", frames))
    page.table("denoising", ["samples", "denoising"] + head, rows)
    visibility(page, "truth", truths[1], PANEL)
    rows = []
    for resolution in (512, 1024, 2048, 4096, 8192):
        rows.append([str(resolution)] + row(None, 64, "@resolution=%d" % resolution))
    page.table("resolution", ["`shadow.resolution`"] + head, rows)


def contact_shadows(page):
    rows = []
    for scene, camera in (("colonnade", "--camera contact"), ("cubes", "")):
        truth = Truth(scene, " ".join((TRUTH, camera)).strip())
        for resolution in (256, 2048):
            for distance in ("0", "0.1", "0.25"):
                setting = "@resolution=%d contact.distance=%s" % (resolution, distance)
                frame = Shadows(scene, setting, more=camera)
                rows.append([scene, short(setting)] + errors(frame, truth))
                if camera and (resolution, distance) in ((256, "0"), (256, "0.25"), (2048, "0")):
                    page.picture("contact%s-%d" % (distance.replace(".", "_"), resolution), frame, UNDER_PANEL)
        if camera:
            page.picture("contact-truth", truth, UNDER_PANEL)
    page.table("contact", ["scene", "setting"] + FIGURES, rows)


def shadow_bias(page):
    settings = ["@bias_kind=constant @constant_bias=%s" % b for b in ("0", "0.01", "0.1")] + ["@bias=%s" % b for b in ("0", "0.4", "4")]
    names = ("constant0", "constant0_01", "constant0_1", "slope0", "slope0_4", "slope4")
    rows = []
    for scene, camera, window, zoom in (("colonnade", "--camera contact", FOOT, 3), ("cubes", "", BLUE_CUBE, 6)):
        truth = Truth(scene, " ".join((TRUTH, camera)).strip())
        for kind in ("@filter=hard", "@filter=pcss"):
            for name, setting in zip(names, settings):
                frame = Shadows(scene, "%s %s" % (kind, setting), more=camera)
                light = "%.4f" % frame.against(truth)["relative_mse"]
                rows.append([scene, short("%s %s" % (kind, setting))] + errors(frame, truth) + [light])
                if kind == "@filter=hard":
                    page.picture("%s-%s" % (scene, name), frame, window, zoom)
        page.picture(scene + "-truth", truth, window, zoom)
    page.table("bias", ["scene", "setting"] + FIGURES + ["relative MSE of direct light"], rows)
    contact_shadows(page)


def box(x, height, z, half):
    """Vertices and indices of a box that stands on the ground."""
    corners = [(x + (half if i & 1 else -half), height if i & 2 else 0.0, z + (half if i & 4 else -half)) for i in range(8)]
    faces = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    return corners, [i for a, b, c, d in faces for i in (a, b, c, a, c, d)]


def write_avenue(path):
    """A glTF file: 200 m of ground, and posts of 4 m along two sides of a road."""
    points = [(-40.0, 0.0, 10.0), (40.0, 0.0, 10.0), (40.0, 0.0, -200.0), (-40.0, 0.0, -200.0)]
    indices = [0, 1, 2, 0, 2, 3]
    for i in range(40):
        for side in (-1, 1):
            corners, triangles = box(3.0 * side, 4.0, -5.0 * i, 0.15)
            indices += [len(points) + k for k in triangles]
            points += corners
    data = b"".join(struct.pack("<3f", *p) for p in points) + struct.pack("<%dI" % len(indices), *indices)
    split = 12 * len(points)
    low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
    gltf = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.55, 0.5, 1], "metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": split},
                        {"buffer": 0, "byteOffset": split, "byteLength": len(data) - split}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    with open(path, "w") as f:
        json.dump(gltf, f)


def shadow_cascades(page):
    avenue = CACHE + "/avenue.gltf"
    write_avenue(avenue)
    truth, rows = Truth(avenue, TRUTH, view="avenue"), []
    for resolution in (512, 1024, 2048):
        for cascades in (1, 2, 4):
            setting = "@cascades=%d @resolution=%d" % (cascades, resolution)
            frame = Shadows(avenue, setting, "avenue")
            rows.append([short(setting)] + errors(frame, truth))
            if resolution == 512:
                page.picture("cascades%d" % cascades, frame)
    for setting in ("@cascade_split=0", "@cascade_split=0.5", "@cascade_blend=0"):
        rows.append([short("@cascades=4 @resolution=512 " + setting)]
                    + errors(Shadows(avenue, "@cascades=4 @resolution=512 " + setting, "avenue"), truth))
    page.table("cascades", ["setting"] + FIGURES, rows)
    page.picture("truth", truth)
    page.picture("index", Shadows(avenue, "@cascades=4 @resolution=512", "avenue", show="cascade_index"))
    page.picture("map", Shadows(avenue, "@cascades=4 @resolution=160", "avenue", show="shadow_map"))


def many_lamps(page):
    truth, frame = Truth("lamps", TRUTH), Shadows("lamps")
    page.picture("tiles", frame)
    page.picture("truth", truth)
    page.picture("count", Shadows("lamps", show="lamp_count"), (0, 0, 20, 12), 16)
    rows = []
    for name, more in (("8 lamps with shadows", ""), ("none", "@lamps=0")):
        figures = Shadows("lamps", more).against(truth)
        rows.append([name] + ["%.4f" % figures[k] for k in ("relative_mse", "flip")] + ["%+.2f %%" % (100 * figures["bias"])])
    page.table("errors", ["shadows"] + FIGURES + ["bias"], rows)


PAGES = {"soft-shadows": soft_shadows, "shadow-noise": shadow_noise, "shadow-bias": shadow_bias,
         "shadow-cascades": shadow_cascades, "many-lamps": many_lamps}
