// Reflects cameras, draws and lights in mirror planes.
#include "renderer/planar_views/planar_view.h"

#include "renderer/draw_shadows/lamp_shadow_maps.h"
#include "renderer/renderer.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr float largestCameraWidth = 4096.0F;  // pixels
constexpr float grid =
    16.0F;  // screen pixels; view edges snap to multiples of it, so that sizes do not change with every camera move

// A crop rectangle in uv.
struct Cut {
    vec2 low;
    vec2 size;
};

Cut cutAround(const Mirror& mirror, const vec2& pixels, float margin) {
    const float wider = margin * pixels.y;
    const vec2 low = glm::floor((mirror.uvLow * pixels - wider) / grid) * grid;
    const vec2 high = glm::ceil((mirror.uvHigh * pixels + wider) / grid) * grid;
    return {low / pixels, (high - low) / pixels};
}

// From the full clip space to that of the crop.
mat4 clipToCut(const Cut& cut) {
    mat4 m(1.0F);
    for (int axis = 0; axis < 2; ++axis) {
        m[axis][axis] = 1.0F / cut.size[axis];
        m[3][axis] = (1.0F - 2.0F * cut.low[axis]) / cut.size[axis] - 1.0F;
    }
    return m;
}

// reflection: applied to the camera; its own inverse. clipToPart: from the camera's clip space to that of the crop.
ViewParams changedView(ViewParams view, const mat4& reflection, const mat4& clipToPart, const vec2& size) {
    view.worldToClip = clipToPart * view.worldToClip * reflection;
    view.clipToWorld = reflection * view.clipToWorld * glm::inverse(clipToPart);
    view.paddedClipToWorld = reflection * view.paddedClipToWorld * glm::inverse(clipToPart);
    view.previousWorldToClip = clipToPart * view.previousWorldToClip * reflection;
    view.eye = reflection * view.eye;
    view.viewPlane = glm::transpose(reflection) * view.viewPlane;
    view.pixelAngle *= view.size.y / (size.y * clipToPart[1][1]);
    view.size = size;
    view.pixel = 1.0F / size;
    return view;
}

vec2 sizeOf(const Cut& cut, const vec2& pixels, float scale) {
    return glm::max(glm::round(cut.size * pixels * scale), vec2(1.0F));
}

}  // namespace

mat4 reflectionIn(const vec4& plane) {
    mat4 m(1.0F);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            m[column][row] -= 2.0F * plane[row] * plane[column];
        }
    }
    return m;
}

ViewParams mirroredView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings) {
    const Cut part = cutAround(mirror, view.size, settings.margin);
    const Cut turned{{1.0F - part.low.x - part.size.x, part.low.y}, part.size};
    mat4 flip(1.0F);
    flip[0][0] = -1.0F;
    return changedView(view, reflectionIn(mirror.plane), clipToCut(turned) * flip,
                       sizeOf(part, view.size, settings.scale));
}

ViewParams croppedView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings) {
    const Cut part = cutAround(mirror, view.size, settings.margin);
    return changedView(view, mat4(1.0F), clipToCut(part), sizeOf(part, view.size, settings.scale));
}

Camera mirrorCamera(const Mirror& mirror, const PlanarSettings& settings) {
    Camera camera;
    camera.position = pointOn(mirror, 0.5F * (mirror.low + mirror.high));
    camera.target = camera.position + vec3(mirror.plane);
    camera.up = mirror.up;
    camera.fovY = glm::radians(settings.cameraFov);
    return camera;
}

MirroredScene mirroredScene(const ViewInputs& in, const Mirror& mirror, const ShadowSettings& settings,
                            uint32_t largestSide) {
    const mat4 reflection = reflectionIn(mirror.plane);
    MirroredScene room{in.draws, in.lamps, {}, mat3(reflection) * in.sunDirection};
    room.draws.boundsW = Aabb{};
    room.draws.version = 0;
    for (Draw& draw : room.draws.draws) {
        draw.objectToWorld = reflection * draw.objectToWorld;
        draw.previousObjectToWorld = reflection * draw.previousObjectToWorld;
        draw.boundsW = transformed(draw.boundsW, reflection);
        room.draws.boundsW.add(draw.boundsW);
    }
    for (uint32_t i = 0; i < room.lamps.count; ++i) {
        LampParams& lamp = room.lamps.lamps[i];
        lamp.position = vec3(reflection * vec4(lamp.position, 1.0F));
        lamp.toLamp = mat3(reflection) * lamp.toLamp;
        lamp.shadow = noLampShadow;
        lamp.intensity = lamp.type == lampReflected ? vec3(0.0F) : lamp.intensity;  // mirrors of the copy have no sun
    }
    const vec4 near = reflection * in.view.clipToWorld * vec4(0, 0, 1, 1);  // the middle of the near plane
    const LampShadowScene scene{room.draws.boundsW, vec3(near) / near.w, mat3(reflection) * vec3(in.view.viewPlane)};
    room.lampShadows = planLampShadows(room.lamps, settings, largestSide, scene, [](const std::string&) {});
    return room;
}

ViewInputs mirrorViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings) {
    ViewInputs view = in;
    view.clipPlane = mirror.plane - vec4(0, 0, 0, mirror.tolerance);
    view.medium.reset();  // that view's camera is behind the mirror
    if (settings.form != PlanarForm::camera) {
        view.view = mirroredView(in.view, mirror, settings);
        return view;
    }
    const vec2 sides = mirror.high - mirror.low;
    const float width = static_cast<float>(settings.cameraSize) * sides.x / std::max(sides.y, 1e-6F);
    const uvec2 size(glm::clamp(width, 1.0F, largestCameraWidth), settings.cameraSize);
    view.view = makeViewParams(mirrorCamera(mirror, settings), size, in.view);
    return view;
}

ViewInputs duplicateViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings,
                               const MirroredScene& room) {
    return {.draws = room.draws,
            .view = croppedView(in.view, mirror, settings),
            .sunDirection = room.sunDirection,
            .sunIrradiance = in.sunIrradiance,
            .sunAngularDiameter = in.sunAngularDiameter,
            .environment = in.environment,
            .lamps = room.lamps,
            .lampShadows = room.lampShadows,
            .ggxTable = in.ggxTable,
            .blueNoise = in.blueNoise,
            .clipPlane = -mirror.plane - vec4(0, 0, 0, mirror.tolerance)};
}

MirrorParams mirrorParams(const Mirror& mirror, const PlanarSettings& settings) {
    MirrorParams p{};
    p.plane = mirror.plane;
    p.center = pointOn(mirror, 0.5F * (mirror.low + mirror.high));
    p.right = mirror.right;
    p.up = mirror.up;
    p.halfSize = glm::max(0.5F * (mirror.high - mirror.low), vec2(1e-6F));
    p.tolerance = mirror.tolerance;
    p.blur = settings.cameraBlur;
    return p;
}

}  // namespace reflet
