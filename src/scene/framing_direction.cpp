// From which side a scene is seen best: a coarse orthographic z-buffer per direction counts visible fronts and backs.
#include "scene/framing_direction.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr int side = 64;             // pixels of the z-buffer
constexpr double enoughSeen = 0.6;   // share of the most that any direction shows
constexpr double mainlyBacks = 2.0;  // times as many backs as fronts
constexpr double mostPixels = 16e6;  // to draw per direction; of more, a share of the triangles is drawn

struct Angles {
    float azimuth;    // degrees from +Z to the right (+X)
    float elevation;  // degrees
};

// In order of preference: three-quarter views, from higher up (flat things), from the other sides (walls and what is
// open to one side), from below.
constexpr std::array candidates{Angles{30, 20},  Angles{30, 40},  Angles{-30, 20}, Angles{60, 20}, Angles{-60, 20},
                                Angles{0, 10},   Angles{150, 20}, Angles{210, 20}, Angles{90, 10}, Angles{-90, 10},
                                Angles{180, 10}, Angles{30, 60},  Angles{30, -40}};

vec3 towardsCamera(const Angles& angles) {
    const float azimuth = glm::radians(angles.azimuth);
    const float elevation = glm::radians(angles.elevation);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

float pixelsPerUnit(const Aabb& box) {
    return float(side) / std::max(glm::length(box.size()), 1e-18F);
}

enum class Side : uint8_t { none, front, back };

class VisibleSides {
public:
    VisibleSides(const vec3& toCamera, const Aabb& box) : toCamera_(toCamera), center_(box.center()) {
        right_ = glm::normalize(glm::cross(vec3(0, 1, 0), toCamera));
        up_ = glm::cross(toCamera, right_);
        scale_ = pixelsPerUnit(box);
        nearest_.fill(std::numeric_limits<float>::lowest());
        sides_.fill(Side::none);
    }

    void draw(const FramedTriangle& triangle) {
        std::array<vec3, 3> p;
        std::ranges::transform(triangle.corners, p.begin(), [&](const vec3& v) { return toPixels(v); });
        const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        if (!(std::abs(area) > 0.0F) || (area < 0.0F && !triangle.doubleSided)) {
            return;
        }
        const Side facing = area > 0.0F ? Side::front : Side::back;
        const vec3 low = glm::floor(glm::min(p[0], glm::min(p[1], p[2])));
        const vec3 high = glm::floor(glm::max(p[0], glm::max(p[1], p[2])));
        bool drawn = false;
        for (int y = std::max(int(low.y), 0); y <= std::min(int(high.y), side - 1); ++y) {
            for (int x = std::max(int(low.x), 0); x <= std::min(int(high.x), side - 1); ++x) {
                const vec2 at{float(x) + 0.5F, float(y) + 0.5F};
                const float u = cross(p[0], p[1], at) / area;  // of corner 2
                const float v = cross(p[1], p[2], at) / area;  // of corner 0
                if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F) {
                    set(x, y, v * p[0].z + (1.0F - u - v) * p[1].z + u * p[2].z, facing);
                    drawn = true;
                }
            }
        }
        for (size_t i = 0; i < 3 && !drawn; ++i) {  // too thin or too small to cover a pixel's centre: its edges
            drawLine(p.at(i), p.at((i + 1) % 3), facing);
        }
    }

    [[nodiscard]] double count(Side wanted) const { return double(std::ranges::count(sides_, wanted)); }

private:
    [[nodiscard]] vec3 toPixels(const vec3& p) const {
        const vec3 d = p - center_;
        const float half = 0.5F * float(side);
        return {half + scale_ * glm::dot(d, right_), half + scale_ * glm::dot(d, up_), scale_ * glm::dot(d, toCamera_)};
    }

    static float cross(const vec3& a, const vec3& b, const vec2& p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    }

    void drawLine(const vec3& a, const vec3& b, Side facing) {
        const int steps = std::max(int(std::abs(a.x - b.x)), int(std::abs(a.y - b.y))) + 1;
        for (int i = 0; i < steps; ++i) {
            const vec3 p = glm::mix(a, b, float(i) / float(steps));
            set(int(p.x), int(p.y), p.z, facing);
        }
    }

    void set(int x, int y, float near, Side facing) {
        if (x < 0 || x >= side || y < 0 || y >= side) {
            return;
        }
        const auto i = static_cast<size_t>(y * side + x);
        if (near > nearest_[i]) {
            nearest_[i] = near;
            sides_[i] = facing;
        }
    }

    vec3 toCamera_;
    vec3 center_;
    vec3 right_;
    vec3 up_;
    float scale_;
    std::array<float, size_t(side) * side> nearest_{};
    std::array<Side, size_t(side) * side> sides_{};
};

// All of them, unless very many are large: then a share, spread evenly over their order by the golden ratio, which
// keeps step with no pattern in it.
std::vector<FramedTriangle> drawnOf(const std::vector<FramedTriangle>& triangles, const Aabb& box) {
    double pixels = 0.0;  // that they cover, roughly and at most, seen from the side that shows most
    for (const FramedTriangle& t : triangles) {
        const vec3 edge1 = t.corners[1] - t.corners[0];
        const vec3 edge2 = t.corners[2] - t.corners[0];
        const float longest = std::max(glm::dot(edge1, edge1), glm::dot(edge2, edge2));
        pixels += std::min(double(side) * side, double(longest) * pixelsPerUnit(box) * pixelsPerUnit(box));
    }
    std::vector<FramedTriangle> drawn;
    for (size_t i = 0; i < triangles.size(); ++i) {
        if (glm::fract(double(i) * 0.6180339887498949) * pixels <= mostPixels) {
            drawn.push_back(triangles[i]);
        }
    }
    return drawn;
}

struct Hit {
    float distance = std::numeric_limits<float>::max();
    bool front = false;
};

// Nearest hit of the ray (T. Moeller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997).
Hit nearestHit(const std::vector<FramedTriangle>& triangles, const vec3& origin, const vec3& direction) {
    Hit hit;
    for (const FramedTriangle& t : triangles) {
        const vec3 edge1 = t.corners[1] - t.corners[0];
        const vec3 edge2 = t.corners[2] - t.corners[0];
        const vec3 p = glm::cross(direction, edge2);
        const float determinant = glm::dot(edge1, p);
        if (determinant == 0.0F) {
            continue;
        }
        const vec3 s = origin - t.corners[0];
        const vec3 q = glm::cross(s, edge1);
        const float u = glm::dot(s, p) / determinant;
        const float v = glm::dot(direction, q) / determinant;
        const float distance = glm::dot(edge2, q) / determinant;
        if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F && distance < hit.distance) {
            hit = {distance, determinant > 0.0F};
        }
    }
    return hit;
}

}  // namespace

vec3 threeQuarterView() {
    return -towardsCamera(candidates[0]);
}

std::optional<vec3> bestViewDirection(const std::vector<FramedTriangle>& triangles, const Aabb& box) {
    std::array<double, candidates.size()> scores{};
    bool room = !triangles.empty();
    const std::vector<FramedTriangle> drawn = drawnOf(triangles, box);
    for (size_t i = 0; i < candidates.size(); ++i) {
        VisibleSides sides(towardsCamera(candidates.at(i)), box);
        for (const FramedTriangle& triangle : drawn) {
            sides.draw(triangle);
        }
        const double fronts = sides.count(Side::front);
        const double backs = sides.count(Side::back);
        scores.at(i) = fronts - backs;
        room = room && backs > mainlyBacks * fronts;
    }
    if (room) {
        return std::nullopt;
    }
    const double most = *std::ranges::max_element(scores);
    if (most <= 0.0) {
        return threeQuarterView();
    }
    const auto found = std::ranges::find_if(scores, [&](double s) { return s >= enoughSeen * most; });
    return -towardsCamera(candidates.at(static_cast<size_t>(found - scores.begin())));
}

std::optional<InsideView> viewInside(const std::vector<FramedTriangle>& triangles, const Aabb& box) {
    const vec3 size = box.size();
    const vec3 along = size.x > size.z ? vec3(1, 0, 0) : vec3(0, 0, 1);
    const float length = std::max(size.x, size.z);
    std::optional<InsideView> best;
    float longest = 0.5F * length;
    for (const float height : {0.5F, 0.65F, 0.35F}) {
        const vec3 middle{box.center().x, box.min.y + height * size.y, box.center().z};
        const Hit behind = nearestHit(triangles, middle, along);
        const Hit ahead = nearestHit(triangles, middle, -along);
        const float free = behind.distance + ahead.distance;
        if (behind.front && ahead.front && free > longest) {
            longest = free;
            best = InsideView{middle + 0.9F * behind.distance * along, middle - 0.5F * ahead.distance * along};
        }
    }
    return best;
}

}  // namespace reflet
