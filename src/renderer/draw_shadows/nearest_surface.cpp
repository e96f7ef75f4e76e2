// Finds how near to the camera surfaces can be, by bounding boxes clipped to the view.
#include "renderer/draw_shadows/light_space.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

struct Candidate {
    float away;  ///< distance of the eye to the box; orthographic: 0
    Aabb box;
};

class Search {
public:
    explicit Search(const ViewParams& view)
        : view_(view), toDepth_(glm::transpose(mat3(vec3(0.0F), vec3(0.0F), vec3(view.viewPlane)))) {}

    void add(const Aabb& box) {
        if (isBeside(box)) {
            return;
        }
        const vec3 eye(view_.eye);
        const bool central = view_.eye.w > 0.0F;  // else it is a direction
        candidates_.push_back({central ? glm::length(eye - glm::clamp(eye, box.min, box.max)) : 0.0F, box});
    }
    /// Clips boxes to the view from the nearest on, until none can be nearer than what was found.
    float nearest() {
        std::ranges::sort(candidates_, {}, &Candidate::away);
        float nearest = std::numeric_limits<float>::max();
        for (const Candidate& c : candidates_) {
            if (c.away >= nearest * cornerStretch_) {
                break;
            }
            const Aabb seen = visibleBounds(c.box, view_.paddedClipToWorld, toDepth_);
            if (!seen.empty()) {
                nearest = std::min(nearest, std::max(seen.min.z + view_.viewPlane.w, 0.0F));
            }
        }
        return nearest;
    }

private:
    /// Whether the box is on the far side of one of the view's four sides: no need to clip it.
    [[nodiscard]] bool isBeside(const Aabb& box) const {
        return std::ranges::any_of(sides_, [&](const vec4& side) {
            const vec3 low = vec3(side) * box.min;
            const vec3 high = vec3(side) * box.max;
            const vec3 most = glm::max(low, high);
            return most.x + most.y + most.z + side.w < 0.0F;
        });
    }

    const ViewParams& view_;
    mat4 rows_ = glm::transpose(glm::inverse(view_.paddedClipToWorld));
    std::array<vec4, 4> sides_{rows_[3] + rows_[0], rows_[3] - rows_[0], rows_[3] + rows_[1], rows_[3] - rows_[1]};
    mat3 toDepth_;  ///< world space; z: distance in front of the camera, up to a constant
    /// Distance from the eye, per distance in front of it, in the view's corners.
    float cornerStretch_ =
        std::sqrt(1.0F + 0.25F * view_.pixelAngle * view_.pixelAngle * glm::dot(view_.size, view_.size));
    std::vector<Candidate> candidates_;
};

}  // namespace

float nearestSurface(const ViewParams& view, const DrawList& list) {
    Search search(view);
    for (const Draw& draw : list.draws) {
        if (draw.pieces.empty()) {
            search.add(draw.boundsW);
        }
        for (const Aabb& piece : draw.pieces) {
            search.add(transformed(piece, draw.objectToWorld));
        }
    }
    return search.nearest();
}

}  // namespace reflet
