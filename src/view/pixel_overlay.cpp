// Draws the rays of the picked pixel over the image.
#include "view/pixel_inspector.h"

#include <imgui.h>

#include <optional>
#include <utility>

namespace reflet {

namespace {

// Clips a line in clip space to the part in front of the camera.
std::optional<std::pair<vec4, vec4>> inFront(vec4 a, vec4 b) {
    constexpr float nearest = 1e-3F;  // metres in front of a perspective camera; orthographic: w is 1
    if (a.w < nearest && b.w < nearest) {
        return std::nullopt;
    }
    const vec4 middle = glm::mix(a, b, (nearest - a.w) / (b.w - a.w));
    return std::pair(a.w < nearest ? middle : a, b.w < nearest ? middle : b);
}

ImVec2 units(const vec2& v) {
    return {v.x, v.y};
}

}  // namespace

// From pixels of the picture.
vec2 PixelInspector::onWindow(const vec2& pixel) const {
    const PictureRect rect = work_.pictureRect();
    return rect.min + pixel / vec2(work_.live().size) * rect.size;
}

vec2 PixelInspector::onWindowOf(const vec4& clip) const {
    return onWindow((0.5F + 0.5F * vec2(clip) / clip.w) * vec2(work_.live().size));
}

// The diffuse rays, coloured by who answers them: as in the image 'source'.
void PixelInspector::drawHemisphere() const {
    const Settings& s = work_.state.settings;
    constexpr ImU32 screen = IM_COL32(0, 255, 0, 170);
    const ImU32 next = s.traceScene.enabled != 0    ? IM_COL32(255, 255, 0, 150)
                       : s.probes.enabled != 0      ? IM_COL32(255, 0, 255, 150)
                       : s.environment.enabled != 0 ? IM_COL32(80, 80, 255, 170)
                                                    : IM_COL32(120, 120, 120, 150);
    const mat4& toClip = work_.live().view.worldToClip;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const vec3 start = picked_->ray->start;
    const float reach = 0.12F * glm::distance(start, work_.state.view.camera.position);  // of rays that end nowhere
    for (const RecordedSample& sample : picked_->hemisphere) {
        const vec3 end = start + (sample.hits ? sample.distance : reach) * sample.direction;
        if (const auto line = inFront(toClip * vec4(start, 1.0F), toClip * vec4(end, 1.0F))) {
            const ImU32 color = sample.hits && s.traceScreen.enabled != 0 ? screen : next;
            draw.AddLine(units(onWindowOf(line->first)), units(onWindowOf(line->second)), color, 1.0F);
            if (color == screen) {
                draw.AddCircleFilled(units(onWindowOf(line->second)), 2.5F, color, 6);
            }
        }
    }
}

// The look-ups of the sun's shadow: red where something blocks, drawn where it is; else green, beside the point.
void PixelInspector::drawShadowSearch() const {
    const RecordedShadow& shadow = *picked_->shadow;
    const mat4& toClip = work_.live().view.worldToClip;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto onPicture = [&](const vec3& place) {
        const vec4 clip = toClip * vec4(place, 1.0F);
        return clip.w < 1e-3F ? std::nullopt : std::optional(onWindowOf(clip));
    };
    const std::optional<vec2> point = onPicture(shadow.point);
    for (const RecordedShadow::Texel& texel : shadow.texels) {
        const std::optional<vec2> at = onPicture(texel.place);
        if (!at || !point) {
            continue;
        }
        if (texel.blocks) {
            draw.AddLine(units(*point), units(*at), IM_COL32(255, 90, 80, 90), 1.0F);
        }
        draw.AddCircleFilled(units(*at), 2.5F, texel.blocks ? IM_COL32(255, 90, 80, 255) : IM_COL32(90, 230, 110, 255),
                             6);
    }
}

// The cells of the depth pyramid that the march has read.
void PixelInspector::drawCells() const {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    constexpr float smallest = 4.0F;  // side of a square that can be told from a dot
    for (const PickedCell& cell : picked_->cells) {
        const vec2 low = onWindow(cell.corner);
        const vec2 high = onWindow(cell.corner + cell.size);
        if (!cell.isPixel || high.x - low.x >= smallest) {
            draw.AddRect(units(low), units(high), IM_COL32(120, 200, 255, 110));
        } else {
            draw.AddCircleFilled(units(0.5F * (low + high)), 1.8F, IM_COL32(120, 200, 255, 220), 6);
        }
    }
}

void PixelInspector::drawMirrorRay(const RecordedRay& ray) const {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const mat4& toClip = work_.live().view.worldToClip;
    const auto line =
        inFront(toClip * vec4(ray.start, 1.0F), toClip * vec4(ray.start + ray.distance * ray.direction, 1.0F));
    if (!line) {
        return;
    }
    const vec2 start = onWindowOf(line->first);
    const vec2 end = onWindowOf(line->second);
    const bool hit = countsAsHit(ray, work_.state.settings.traceScreen);
    const ImU32 color = hit ? IM_COL32(90, 230, 110, 255) : IM_COL32(255, 90, 80, 255);
    draw.AddLine(units(start), units(end), color, 1.5F);
    draw.AddCircleFilled(units(start), 2.5F, color, 8);
    if (hit) {
        draw.AddCircle(units(end), 6.0F, color, 16, 2.0F);
    } else {
        draw.AddLine(units(end - 5.0F), units(end + 5.0F), color, 2.0F);
        draw.AddLine(units(end + vec2(-5.0F, 5.0F)), units(end + vec2(5.0F, -5.0F)), color, 2.0F);
    }
}

// The cells and the pixel are valid only for the view at the time of the pick. The ray is in world space and is also
// drawn from other views.
void PixelInspector::drawOverlay() const {
    if (!picked_ || work_.live().frames == 0) {
        return;
    }
    const PictureRect rect = work_.pictureRect();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.PushClipRect(units(rect.min), units(rect.min + rect.size));
    const bool asPicked = isPickedView();
    if (picked_->shadow && explains_ == Explains::shadow) {
        drawShadowSearch();
    } else if (picked_->ray && explains_ == Explains::diffuse) {
        drawHemisphere();
    } else if (picked_->ray) {
        if (asPicked) {
            drawCells();
        }
        drawMirrorRay(*picked_->ray);
    }
    if (asPicked) {
        draw.AddCircle(units(onWindow(vec2(picked_->pixel) + 0.5F)), 5.0F, IM_COL32(255, 255, 255, 255), 16, 1.5F);
    }
    draw.PopClipRect();
}

}  // namespace reflet
