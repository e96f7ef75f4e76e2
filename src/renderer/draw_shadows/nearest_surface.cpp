// Finds how near to the camera surfaces can be, by bounding boxes clipped to the view.
#include "renderer/draw_shadows/light_space.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

class Search {
public:
    explicit Search(const ViewParams& view)
        : view_(view), toDepth_(glm::transpose(mat3(vec3(0.0F), vec3(0.0F), vec3(view.viewPlane)))) {}

    /// Whether anything in the box may be nearer than what is known.
    [[nodiscard]] bool mayImprove(const Aabb& box) const {
        const vec3 eye(view_.eye);
        const float away = glm::length(eye - glm::clamp(eye, box.min, box.max));
        return away < nearest_ * cornerStretch_;
    }
    void add(const Aabb& box) {
        const Aabb seen = visibleBounds(box, view_.paddedClipToWorld, toDepth_);
        if (!seen.empty()) {
            nearest_ = std::min(nearest_, std::max(seen.min.z + view_.viewPlane.w, 0.0F));
        }
    }
    [[nodiscard]] float nearest() const { return nearest_; }

private:
    const ViewParams& view_;
    mat3 toDepth_;  ///< world space; z: distance in front of the camera, up to a constant
    /// Distance from the eye, per distance in front of it, in the view's corners.
    float cornerStretch_ =
        std::sqrt(1.0F + 0.25F * view_.pixelAngle * view_.pixelAngle * glm::dot(view_.size, view_.size));
    float nearest_ = std::numeric_limits<float>::max();
};

}  // namespace

float nearestSurface(const ViewParams& view, const DrawList& list) {
    Search search(view);
    for (const Draw& draw : list.draws) {
        if (!search.mayImprove(draw.boundsW)) {
            continue;
        }
        if (draw.pieces.empty()) {
            search.add(draw.boundsW);
        }
        for (const Aabb& piece : draw.pieces) {
            const Aabb box = transformed(piece, draw.objectToWorld);
            if (search.mayImprove(box)) {
                search.add(box);
            }
        }
    }
    return search.nearest();
}

}  // namespace reflet
