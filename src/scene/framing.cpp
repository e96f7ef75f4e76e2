// The camera of a scene that brings none.
#include "scene/framing.h"

#include "base/error.h"
#include "scene/framing_direction.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float usualFov = glm::radians(45.0F);
constexpr float insideFov = glm::radians(65.0F);
constexpr size_t mostPoints = size_t(1) << 24U;        // beyond, instances count as their boxes
constexpr size_t sampledTriangles = size_t(1) << 16U;  // about as many decide on the direction
constexpr size_t leastPerInstance = 12;
constexpr float largeGround = 5.0F;  // times the size of the rest, which are background then
constexpr float largeDome = 10.0F;
constexpr size_t mostBackgrounds = 3;
constexpr float farthest = 1e18F;  // products of coordinates beyond this overflow [m]

bool isSomewhere(const vec3& v) {
    return std::abs(v.x) < farthest && std::abs(v.y) < farthest && std::abs(v.z) < farthest;
}

// Camera space relative to the points' middle: x right, y up, z ahead.
struct Axes {
    glm::dvec3 origin;
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 ahead;
};

std::vector<vec3> toCameraSpace(const std::vector<vec3>& points, const Axes& axes) {
    std::vector<vec3> result;
    result.reserve(points.size());
    for (const vec3& p : points) {
        const glm::dvec3 d = glm::dvec3(p) - axes.origin;
        result.emplace_back(glm::dot(d, axes.right), glm::dot(d, axes.up), glm::dot(d, axes.ahead));
    }
    return result;
}

Axes axesAlong(const vec3& forward, const vec3& up, const Aabb& box) {
    Axes axes{};
    axes.origin = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
    axes.ahead = forward;
    axes.right = glm::normalize(glm::cross(axes.ahead, glm::dvec3(up)));
    axes.up = glm::cross(axes.right, axes.ahead);
    return axes;
}

// Moves an orthographic camera, without turning it, so that it has all points within the framed share of the image.
void fitOrthographic(Camera& camera, const std::vector<vec3>& points, const vec3& forward, float aspect) {
    Aabb box;
    for (const vec3& p : points) {
        box.add(p);
    }
    const Axes axes = axesAlong(forward, camera.up, box);
    Aabb seen;
    for (const vec3& p : toCameraSpace(points, axes)) {
        seen.add(p);
    }
    const vec3 size = seen.size();
    const glm::dvec3 middle(seen.center());
    const double slack = std::max(0.05 * double(glm::length(size)), 1e-3);
    const double away = 0.5 * double(size.z) + slack + double(camera.near);
    const glm::dvec3 target = axes.origin + axes.right * middle.x + axes.up * middle.y + axes.ahead * middle.z;
    camera.orthographicHeight = std::max(std::max(size.y, size.x / aspect) / framedShare, 1e-3F);
    camera.target = vec3(target);
    camera.position = vec3(target - axes.ahead * away);
    camera.far = std::max(camera.far, float(away + 0.5 * double(size.z) + slack));
}

// The farthest-ahead z from which all points are within ±slope along the axis. Each side of the frustum is a plane
// that must pass outside of all points: x - slope·z and -x - slope·z are bounded.
double fittingDepth(const std::vector<vec3>& points, int axis, double slope) {
    double right = std::numeric_limits<double>::lowest();
    double left = right;
    for (const vec3& p : points) {
        right = std::max(right, p[axis] - slope * p.z);
        left = std::max(left, -p[axis] - slope * p.z);
    }
    return -0.5 * (right + left) / slope;
}

// Where the camera is along the axis so that the projections reach equally far to both sides. The sum of the largest
// and the smallest projection falls with the position and is piecewise linear: Newton's method, within a bracket.
double centred(const std::vector<vec3>& points, int axis, double depth) {
    const auto byAxis = [&](const vec3& a, const vec3& b) { return a[axis] < b[axis]; };
    const auto [least, most] = std::ranges::minmax_element(points, byAxis);
    double low = (*least)[axis];
    double high = (*most)[axis];
    double at = 0.5 * (low + high);
    for (int i = 0; i < 40 && low < high; ++i) {
        double largest = std::numeric_limits<double>::lowest();
        double smallest = std::numeric_limits<double>::max();
        glm::dvec2 first(0.0);  // position and distance of the extreme points
        glm::dvec2 last(0.0);
        for (const vec3& p : points) {
            const double distance = p.z - depth;
            const double projected = (p[axis] - at) / distance;
            if (projected > largest) {
                largest = projected;
                last = {p[axis], distance};
            }
            if (projected < smallest) {
                smallest = projected;
                first = {p[axis], distance};
            }
        }
        if (std::abs(largest + smallest) <= 1e-6 * (largest - smallest)) {
            break;
        }
        (largest + smallest > 0.0 ? low : high) = at;
        const double next = (first.x * last.y + last.x * first.y) / (first.y + last.y);
        at = next > low && next < high ? next : 0.5 * (low + high);
    }
    return at;
}

float nearPlane(float distance, float nearest) {
    // Clips nothing that is framed, and leaves room to move in: reversed float depth has the precision for it. The
    // limits are those of view files.
    return std::clamp(std::min(0.01F * distance, 0.9F * nearest), 1e-6F, 1000.0F);
}

struct Subject {
    std::vector<vec3> points;
    std::vector<FramedTriangle> triangles;
};

bool isMirrored(const Scene& scene, const ScenePose& pose, size_t instance) {
    const int32_t skin = scene.instances[instance].skin;
    return skin >= 0 ? flipsWinding(pose.skins[static_cast<size_t>(skin)])
                     : glm::determinant(mat3(pose.objectToWorld[instance])) < 0.0F;
}

std::vector<FramedTriangle> trianglesOf(const Scene& scene, const ScenePose& pose, size_t instance,
                                        const std::vector<vec3>& positions, size_t most) {
    const Mesh& mesh = scene.meshes.at(scene.instances[instance].mesh);
    const bool doubleSided = scene.materials.at(mesh.material).doubleSided;
    const bool mirrored = isMirrored(scene, pose, instance);
    const size_t step = std::max<size_t>(mesh.indices.size() / 3 / most, 1) * 3;
    std::vector<FramedTriangle> triangles;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += step) {
        FramedTriangle t{{positions[mesh.indices[i]], positions[mesh.indices[i + 1]], positions[mesh.indices[i + 2]]},
                         doubleSided};
        if (mirrored) {
            std::swap(t.corners[1], t.corners[2]);
        }
        if (std::ranges::all_of(t.corners, isSomewhere)) {
            triangles.push_back(t);
        }
    }
    return triangles;
}

Aabb boxOf(const Scene& scene, const ScenePose& pose, size_t instance) {
    const Instance& placed = scene.instances[instance];
    const size_t joints = placed.skin < 0 ? 0 : scene.skins[static_cast<size_t>(placed.skin)].joints.size();
    const Aabb box = instanceBounds(scene, pose, instance, jointBounds(scene.meshes.at(placed.mesh), joints));
    return isSomewhere(box.min) && isSomewhere(box.max) ? box : Aabb{};
}

bool isGround(const Aabb& box) {
    const vec3 size = box.size();
    return size.y < 0.02F * std::min(size.x, size.z);
}

// Whether most of it faces its own middle.
bool isDome(const Scene& scene, const ScenePose& pose, size_t instance, const Aabb& box) {
    float inward = 0.0F;
    float all = 0.0F;
    for (const FramedTriangle& t : trianglesOf(scene, pose, instance, worldPositions(scene, pose, instance), 4096)) {
        const vec3 normal = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        const float facing = glm::dot(normal, box.center() - t.corners[0]);
        inward += facing;
        all += std::abs(facing);
    }
    return inward > 0.7F * all;
}

bool contains(const Aabb& box, const Aabb& inner, bool alsoHeight) {
    const vec3 slack = 0.01F * box.size();
    const auto within = [&](int axis) {
        return inner.min[axis] >= box.min[axis] - slack[axis] && inner.max[axis] <= box.max[axis] + slack[axis];
    };
    return within(0) && within(2) && (!alsoHeight || within(1));
}

// The instances to frame: all but sky domes and ground planes that are far larger than everything else.
std::vector<size_t> subjectOf(const Scene& scene, const ScenePose& pose) {
    std::vector<Aabb> boxes;
    std::vector<size_t> order;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        boxes.push_back(boxOf(scene, pose, i));
        if (!boxes[i].empty()) {
            order.push_back(i);
        }
    }
    const auto diagonal = [&](size_t i) { return glm::length(boxes[i].size()); };
    std::ranges::stable_sort(order, std::ranges::greater{}, diagonal);
    const auto trianglesIn = [&](size_t i) { return scene.meshes.at(scene.instances[i].mesh).indices.size() / 3; };
    std::vector<Aabb> rest(order.size() + 1);  // [i]: of the i-th largest and all smaller ones
    size_t detail = 0;
    for (size_t i = order.size(); i-- > 0;) {
        rest[i] = rest[i + 1];
        rest[i].add(boxes[order[i]]);
        detail += trianglesIn(order[i]);
    }
    size_t backgrounds = 0;
    for (size_t k = 1; k <= mostBackgrounds && k < order.size(); ++k) {
        detail -= trianglesIn(order[k - 1]);
        const bool background = std::ranges::all_of(order.begin(), order.begin() + std::ptrdiff_t(k), [&](size_t i) {
            const float times = diagonal(i) / glm::length(rest[k].size());
            return isGround(boxes[i])
                       ? times > largeGround && contains(boxes[i], rest[k], false) && trianglesIn(i) <= detail
                       : times > largeDome && contains(boxes[i], rest[k], true) && isDome(scene, pose, i, boxes[i]);
        });
        if (background) {
            backgrounds = k;
        }
    }
    order.erase(order.begin(), order.begin() + std::ptrdiff_t(backgrounds));
    return order;
}

Subject gather(const Scene& scene, const ScenePose& pose) {
    const std::vector<size_t> instances = subjectOf(scene, pose);
    size_t all = 0;
    for (const size_t i : instances) {
        all += scene.meshes.at(scene.instances[i].mesh).indices.size() / 3;
    }
    Subject subject;
    for (const size_t i : instances) {
        const Mesh& mesh = scene.meshes.at(scene.instances[i].mesh);
        if (subject.points.size() + mesh.positions.size() > mostPoints) {
            const Aabb box = boxOf(scene, pose, i);
            for (unsigned c = 0; c < 8; ++c) {
                subject.points.push_back(box.corner(c));
            }
            continue;
        }
        const std::vector<vec3> positions = worldPositions(scene, pose, i);
        std::ranges::copy_if(positions, std::back_inserter(subject.points), isSomewhere);
        const auto share = sampledTriangles * (mesh.indices.size() / 3) / std::max<size_t>(all, 1);
        std::ranges::copy(trianglesOf(scene, pose, i, positions, std::max(share, leastPerInstance)),
                          std::back_inserter(subject.triangles));
    }
    return subject;
}

Aabb boxAround(const std::vector<vec3>& points) {
    Aabb box;
    for (const vec3& p : points) {
        box.add(p);
    }
    return box;
}

Camera cameraInside(const InsideView& inside, const Aabb& box) {
    Camera camera;
    camera.fovY = insideFov;
    camera.position = inside.position;
    camera.target = inside.target;
    camera.near = nearPlane(glm::distance(inside.position, inside.target), 0.01F * glm::length(box.size()));
    return camera;
}

// Where the points are during a turn around the vertical through `middle`: circles around it, of which those on the
// convex outline of radius over height enclose all others.
std::vector<vec3> turned(const std::vector<vec3>& points, const vec3& middle) {
    std::vector<vec2> profile;  // height, radius
    for (const vec3& p : points) {
        profile.emplace_back(p.y, std::hypot(p.x - middle.x, p.z - middle.z));
    }
    std::ranges::sort(profile, [](const vec2& a, const vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<vec2> outline;  // the upper convex hull, by A. M. Andrew's monotone chain (1979)
    for (const vec2& p : profile) {
        const auto isInside = [&] {
            const vec2 a = outline[outline.size() - 2];
            const vec2 b = outline.back();
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0F;
        };
        while (outline.size() >= 2 && isInside()) {
            outline.pop_back();
        }
        outline.push_back(p);
    }
    constexpr int steps = 96;
    std::vector<vec3> circles;
    for (const vec2& p : outline) {
        for (int i = 0; i < steps; ++i) {
            const float angle = 2.0F * pi * float(i) / float(steps);
            circles.emplace_back(middle.x + p.y * std::sin(angle), p.x, middle.z + p.y * std::cos(angle));
        }
    }
    return circles;
}

}  // namespace

Camera fitCamera(const std::vector<vec3>& points, const vec3& forward, float fovY, float aspect, const vec3& up) {
    REFLET_CHECK(aspect > 0.0F && fovY > 0.0F, "aspect {}, fovY {}", aspect, fovY);
    Aabb box;
    for (const vec3& p : points) {
        box.add(p);
    }
    if (box.empty()) {
        box.add(vec3(0.0F));
    }
    const Axes axes = axesAlong(forward, up, box);
    const std::vector<vec3> local = toCameraSpace(points.empty() ? std::vector<vec3>{vec3(0.0F)} : points, axes);

    const double slopeY = double(framedShare) * std::tan(0.5 * fovY);
    const auto [least, most] = std::ranges::minmax_element(local, {}, &vec3::z);
    const double front = (*least).z;
    const double middle = 0.5 * (front + (*most).z);
    // A needle that points at the camera has no width; and position and target must differ in float precision.
    const double size = glm::length(glm::dvec3(box.max) - glm::dvec3(box.min));
    const double resolution = 1e-6 * glm::length(axes.origin);
    const double gap = size > 0.0 ? std::max(0.05 * size, 16.0 * resolution) : 1.0 + 1000.0 * resolution;
    glm::dvec3 eye;
    eye.z = std::min({fittingDepth(local, 0, slopeY * aspect), fittingDepth(local, 1, slopeY), front - gap});
    eye.x = centred(local, 0, eye.z);
    eye.y = centred(local, 1, eye.z);
    const glm::dvec3 position = axes.origin + axes.right * eye.x + axes.up * eye.y + axes.ahead * eye.z;
    Camera camera;
    camera.fovY = fovY;
    camera.position = vec3(position);
    camera.target = vec3(position + axes.ahead * (middle - eye.z));
    camera.near = nearPlane(float(middle - eye.z), float(front - eye.z));
    return camera;
}

Camera framingCamera(const Scene& scene, float aspect, double time) {
    const Subject subject = gather(scene, scenePose(scene, time));
    if (subject.points.empty()) {
        return {};
    }
    const Aabb box = boxAround(subject.points);
    const std::optional<vec3> forward = bestViewDirection(subject.triangles, box);
    if (!forward) {
        if (const std::optional<InsideView> inside = viewInside(subject.triangles, box)) {
            return cameraInside(*inside, box);
        }
    }
    return fitCamera(subject.points, forward.value_or(threeQuarterView()), usualFov, aspect);
}

TurningCamera turningCamera(const Scene& scene, float aspect, double time, const std::optional<vec3>& forward,
                            float fovY, const vec3& up) {
    const Subject subject = gather(scene, scenePose(scene, time));
    if (subject.points.empty()) {
        return {};
    }
    const Aabb box = boxAround(subject.points);
    const std::optional<vec3> best = forward ? forward : bestViewDirection(subject.triangles, box);
    if (!best) {
        if (const std::optional<InsideView> inside = viewInside(subject.triangles, box)) {
            return {cameraInside(*inside, box), inside->position};
        }
    }
    const vec3 along = best.value_or(threeQuarterView());
    Camera camera = fitCamera(turned(subject.points, box.center()), along, fovY > 0.0F ? fovY : usualFov, aspect, up);
    camera.up = up;
    // The target moves along the view to the axis.
    const vec2 toAxis(box.center().x - camera.position.x, box.center().z - camera.position.z);
    const vec2 ahead(along.x, along.z);
    const float distance = glm::dot(toAxis, ahead) / std::max(glm::dot(ahead, ahead), 1e-12F);
    if (distance > 0.0F) {
        camera.target = camera.position + distance * along;
    }
    return {camera, camera.target};
}

void frameScene(Camera& camera, const Scene& scene, float aspect, double time) {
    const Subject subject = gather(scene, scenePose(scene, time));
    if (subject.points.empty()) {
        return;
    }
    const vec3 forward = glm::normalize(camera.target - camera.position);
    if (camera.orthographicHeight > 0.0F) {
        fitOrthographic(camera, subject.points, forward, aspect);
    } else {
        const Camera fitted = fitCamera(subject.points, forward, camera.fovY, aspect, camera.up);
        camera.position = fitted.position;
        camera.target = fitted.target;
        camera.near = fitted.near;
    }
    camera.aims = true;
    camera.node = -1;
}

}  // namespace reflet
