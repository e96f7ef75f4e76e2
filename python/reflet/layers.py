"""What the layers of a frame mean: how they add up, and how frames follow each other. docs/datasets.md."""

import numpy as np


def recombine(layers):
    """final, from its parts: direct + indirect_diffuse + indirect_specular."""
    return layers["direct"] + layers["indirect_diffuse"] + layers["indirect_specular"]


def _pixel_centres(shape):
    height, width = shape
    u = (np.arange(width) + 0.5) / width
    v = (np.arange(height) + 0.5) / height
    return np.stack(np.meshgrid(u, v), axis=-1)


def _in_view(frame):
    """View-space points of all pixels; of the background their directions, one metre along the view axis."""
    depth = frame["depth"].astype(np.float64)
    clip = frame.matrix("view_to_clip")
    ndc = 2 * _pixel_centres(depth.shape) - 1
    away = np.where(depth > 0, depth, 1.0)
    # Clip space has w = depth (perspective) or 1 (orthographic).
    w = away if clip[3, 2] != 0 else np.ones_like(away)
    x = (ndc[..., 0] * w - clip[0, 3] + clip[0, 2] * away) / clip[0, 0]
    y = (ndc[..., 1] * w - clip[1, 3] + clip[1, 2] * away) / clip[1, 1]
    return np.stack([x, y, -away], axis=-1)


def positions(frame):
    """World-space positions of the surfaces at pixel centres, height x width x 3; not a number in the background."""
    view = _in_view(frame)
    to_world = np.linalg.inv(frame.matrix("world_to_view"))
    world = view @ to_world[:3, :3].T + to_world[:3, 3]
    world[frame["depth"] <= 0] = np.nan
    return world


def _to_previous_view(frame):
    return frame.matrix("previous_world_to_view") @ np.linalg.inv(frame.matrix("world_to_view"))


def _background_was_in_front(frame):
    """Where the direction of a pixel was in front of the camera before, too."""
    directions = _in_view(frame)
    if frame.matrix("view_to_clip")[3, 2] == 0:  # orthographic: all look the same way
        directions = directions * (0, 0, 1)
    return (directions @ _to_previous_view(frame)[:3, :3].T)[..., 2] < 0


def static_motion(frame):
    """The motion that every pixel has if nothing but the camera moves, and the depth in the frame before."""
    view = np.concatenate([_in_view(frame), (frame["depth"] > 0)[..., None].astype(np.float64)], axis=-1)
    then = view @ _to_previous_view(frame).T
    clip = then @ frame.matrix("previous_view_to_clip").T
    uv = 0.5 + 0.5 * clip[..., :2] / clip[..., 3:]
    return _pixel_centres(frame["depth"].shape) - uv, np.where(frame["depth"] > 0, -then[..., 2], 0.0)


def _sampled(image, uv):
    """Bilinear, with the image's edge beyond it."""
    height, width = image.shape[:2]
    x = np.clip(uv[..., 0] * width - 0.5, 0, width - 1)
    y = np.clip(uv[..., 1] * height - 0.5, 0, height - 1)
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    x1, y1 = np.minimum(x0 + 1, width - 1), np.minimum(y0 + 1, height - 1)
    fx, fy = x - x0, y - y0
    if image.ndim == 3:
        fx, fy = fx[..., None], fy[..., None]
    upper = image[y0, x0] * (1 - fx) + image[y0, x1] * fx
    lower = image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    return (upper * (1 - fy) + lower * fy).astype(np.float32)


def reproject(frame, previous, image=None, tolerance=0.02):
    """The previous frame's image where its surfaces are now, and a mask of where it shows the same surface.

    image: of the previous frame, height x width or height x width x channels; default its final. The mask is false
    where the point was outside of the image, or where another surface was in front of it: the depths differ by more
    than the tolerance, a share of the depth.
    """
    image = previous["final"] if image is None else image
    depth = previous["depth"]
    height, width = depth.shape
    uv = _pixel_centres(depth.shape) - frame["motion"]
    inside = np.all((uv >= 0) & (uv < 1), axis=-1)
    x = np.clip((uv[..., 0] * width).astype(int), 0, width - 1)
    y = np.clip((uv[..., 1] * height).astype(int), 0, height - 1)
    there, expected = depth[y, x], frame["previous_depth"]
    surface = frame["depth"] > 0
    # A pixel's depth changes along a slanted surface: by as much as between its neighbours.
    slope = np.maximum(*(np.abs(g) for g in np.gradient(depth)))[y, x]
    # What was behind the camera has a motion of 0, which leads to a place in the image that shows something else.
    same = np.where(surface,
                    (there > 0) & (expected > 0)
                    & (np.abs(there - expected) <= tolerance * np.abs(expected) + slope),
                    (there <= 0) & _background_was_in_front(frame))
    return _sampled(image, uv), inside & same


def tone_map(radiance, exposure=0.0):
    """Display values of 0 to 1, sRGB-encoded, by the program's default curve (Khronos PBR Neutral, 2024).

    exposure: in stops, as frame.exposure.
    """
    c = np.maximum(np.nan_to_num(np.asarray(radiance, np.float64)), 0) * 2.0 ** exposure
    start, desaturation = 0.8 - 0.04, 0.15
    lowest = c.min(axis=-1, keepdims=True)
    c = c - np.where(lowest < 0.08, lowest - 6.25 * lowest ** 2, 0.04)
    peak = c.max(axis=-1, keepdims=True)
    room = 1 - start
    compressed = 1 - room ** 2 / (np.maximum(peak, start) + room - start)
    grey = 1 - 1 / (desaturation * (peak - compressed) + 1)
    bright = c * compressed / np.maximum(peak, 1e-9) * (1 - grey) + compressed * grey
    c = np.clip(np.where(peak < start, c, bright), 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055).astype(np.float32)


def check(frame):
    """What of the contract of layers can be tested on one frame, as a dict of errors that should be near 0.

    sum, noisy_sum: largest |recombined - final| over final's largest component + 0.01.
    motion: 99th percentile over surfaces of the distance in pixels to static_motion; None in animated scenes.
    normal: largest deviation of a normal's length from 1.  finite: number of values that are no numbers.
    """
    def sum_error(layers):
        whole = layers["unfiltered"] if "unfiltered" in layers else layers["final"]  # of presets: before antialiasing
        scale = np.abs(whole).max(axis=-1, keepdims=True) + 0.01
        return float((np.abs(recombine(layers) - whole) / scale).max())

    errors = {"finite": int(sum(np.count_nonzero(~np.isfinite(image)) for image in frame.values())),
              "sum": None, "noisy_sum": None, "motion": None}
    if "direct" in frame:
        errors["sum"] = sum_error(frame)
        errors["noisy_sum"] = max((sum_error(noisy) for noisy in frame.noisy.values()), default=0.0)
    surface = np.abs(frame["normal"]).sum(axis=-1) > 0
    length = np.linalg.norm(frame["normal"], axis=-1)
    errors["normal"] = float(np.abs(length - 1)[surface].max()) if surface.any() else 0.0
    if "motion" in frame and not frame.record["animated"]:
        expected, _ = static_motion(frame)
        height, width = frame["depth"].shape
        off = np.linalg.norm((frame["motion"] - expected) * (width, height), axis=-1)
        errors["motion"] = float(np.percentile(off, 99))
    return errors
