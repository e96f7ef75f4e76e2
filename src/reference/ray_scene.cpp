// Implements RayScene with Embree, version 3 or 4.
#include "reference/ray_scene.h"

#include "base/error.h"
#include "reference/sampler.h"
#include "reference/surface.h"
#include "scene/volumes_around.h"

#if REFLET_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <memory>
#include <type_traits>

namespace reflet {

// Data of an instance for the filter functions.
struct EmbreeGeometry {
    const RayScene* owner = nullptr;
    uint32_t instance = 0;
    bool mirrored = false;
    bool doubleSided = false;
    bool volume = false;
    mat3 normalToWorld{1.0F};
    const vec3* positions = nullptr;  ///< world space; Embree owns them
};

namespace {

// Farthest coordinate, and largest scale of an instance [m]: the fourth power of a length, in the squared length of a
// cross product, is still a float. Beyond, normals are no numbers, and Embree's hierarchy can be none.
constexpr float farthest = 1e9F;

bool isWithin(const vec3& v) {
    return std::abs(v.x) <= farthest && std::abs(v.y) <= farthest && std::abs(v.z) <= farthest;  // NaN is not
}

vec2 barycentricOf(const RTCFilterFunctionNArguments& args) {
    return {RTCHitN_u(args.hit, args.N, 0), RTCHitN_v(args.hit, args.N, 0)};
}

const EmbreeGeometry& geometryOf(const RTCFilterFunctionNArguments& args) {
    return *static_cast<const EmbreeGeometry*>(args.geometryUserPtr);
}

// Alpha test: rejects hits where the alpha is below the cutoff; of blended surfaces by chance, so that the ray hits
// with a probability of alpha (E. Enderton et al., Stochastic Transparency, 2010).
void passCutOut(const RTCFilterFunctionNArguments* args) {
    const EmbreeGeometry& g = geometryOf(*args);
    const Hit hit{0.0F, g.instance, RTCHitN_primID(args->hit, args->N, 0), barycentricOf(*args)};
    const uint32_t random = RTCRayN_id(args->ray, args->N, 0);
    const uint32_t hash = mixBits(random ^ mixBits(hit.triangle ^ mixBits(hit.instance)));
    const float cutoff = random == 0 ? 1.0F : (static_cast<float>(hash >> 8U) + 0.5F) * 0x1p-24F;
    if (isCutOut(*g.owner, hit, cutoff)) {
        args->valid[0] = 0;
    }
}

// Also rejects the back faces of single-sided surfaces, for camera rays.
void passBacks(const RTCFilterFunctionNArguments* args) {
    const EmbreeGeometry& g = geometryOf(*args);
    if (g.doubleSided) {
        return;
    }
    const vec3 normal(RTCHitN_Ng_x(args->hit, args->N, 0), RTCHitN_Ng_y(args->hit, args->N, 0),
                      RTCHitN_Ng_z(args->hit, args->N, 0));
    const vec3 direction(RTCRayN_dir_x(args->ray, args->N, 0), RTCRayN_dir_y(args->ray, args->N, 0),
                         RTCRayN_dir_z(args->ray, args->N, 0));
    if ((glm::dot(normal, direction) > 0.0F) != g.mirrored) {
        args->valid[0] = 0;
    }
}

// The same from inside a volume of glass, whose back faces bound what the camera is in.
void passBacksInside(const RTCFilterFunctionNArguments* args) {
    if (!geometryOf(*args).volume) {
        passBacks(args);
    }
}

// Context of a query; the two versions of Embree differ here and in the calls below.
class Query {
public:
    explicit Query(RayKind kind) {
        const RTCFilterFunctionN filter = kind == RayKind::camera   ? passBacks
                                          : kind == RayKind::inside ? passBacksInside
                                                                    : nullptr;
#if REFLET_EMBREE_MAJOR >= 4
        rtcInitIntersectArguments(&intersect_);
        rtcInitOccludedArguments(&occluded_);
        intersect_.filter = filter;
        occluded_.filter = filter;
        if (filter != nullptr) {
            intersect_.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
            occluded_.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        }
#else
        rtcInitIntersectContext(&context_);
        context_.filter = filter;
#endif
    }
#if REFLET_EMBREE_MAJOR >= 4
    void intersect(RTCScene scene, RTCRayHit& ray) {
        rtcIntersect1(scene, &ray, &intersect_);
    }
    void occluded(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &ray, &occluded_);
    }

private:
    RTCIntersectArguments intersect_{};
    RTCOccludedArguments occluded_{};
#else
    void intersect(RTCScene scene, RTCRayHit& ray) {
        rtcIntersect1(scene, &context_, &ray);
    }
    void occluded(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &context_, &ray);
    }

private:
    RTCIntersectContext context_{};
#endif
};

#if REFLET_EMBREE_MAJOR >= 4
constexpr RTCSceneFlags filterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
constexpr RTCSceneFlags filterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

// Embree ends the program at rays beyond its limit, of 1.8e18, or of no numbers: those of a camera at such a place.
bool isTraceable(const Ray& ray) {
    constexpr float most = 1e18F;
    const auto fits = [](const vec3& v) {
        return std::abs(v.x) < most && std::abs(v.y) < most && std::abs(v.z) < most;
    };
    return fits(ray.origin) && fits(ray.direction) && ray.near >= 0.0F && ray.far >= 0.0F;  // NaN does not
}

struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using GeometryOwner = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

RTCRay embreeRay(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.tnear = ray.near;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.tfar = ray.far;
    r.mask = 0xFFFFFFFFU;
    r.id = ray.random;
    return r;
}

// What happened, and what to do.
const char* embreeText(RTCError error) {
    switch (error) {
        case RTC_ERROR_UNKNOWN:
            return "Embree failed, most often because no thread could be started: raise the limit of processes (ulimit "
                   "-u), or end others";
        case RTC_ERROR_OUT_OF_MEMORY:
            return "out of memory";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "Embree does not support this processor";
        default:
            return "Embree refused it";
    }
}

}  // namespace

struct RayScene::State {
    const Scene& scene;
    std::vector<EmbreeGeometry> geometries;  ///< one per instance; Embree keeps pointers into it
    RTCDevice device = nullptr;
    RTCScene hierarchy = nullptr;

    ~State() {
        rtcReleaseScene(hierarchy);
        rtcReleaseDevice(device);
    }

    // Embree records errors on the device instead of throwing.
    void check(const char* what) const {
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) {
            fail("{}: {} (error {})", what, embreeText(error), static_cast<int>(error));
        }
    }

    void add(EmbreeGeometry& g) {
        const Instance& instance = scene.instances[g.instance];
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const Material& material = scene.materials.at(mesh.material);
        const mat3 m(instance.objectToWorld);
        const auto checkReach = [&](bool within) {
            if (!within) {
                fail(
                    "instance {} '{}' is too far or too large: the reference takes coordinates and scales up to {:g} m",
                    g.instance, instance.name.substr(0, 100), farthest);
            }
        };
        checkReach(isWithin(m[0]) && isWithin(m[1]) && isWithin(m[2]));
        g.mirrored = glm::determinant(m) < 0.0F;
        g.doubleSided = material.doubleSided;
        g.volume = boundsVolume(material);
        // The cofactor matrix: the inverse transpose up to a factor, but defined for singular matrices, too.
        g.normalToWorld =
            mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])) * (g.mirrored ? -1.0F : 1.0F);
        const GeometryOwner owner(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        RTCGeometry geometry = owner.get();
        auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size()));
        check("copying positions");
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            positions[i] = vec3(instance.objectToWorld * vec4(mesh.positions[i], 1.0F));
            checkReach(isWithin(positions[i]));
        }
        g.positions = positions;
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                                   3 * sizeof(uint32_t), mesh.indices.size() / 3);
        rtcSetGeometryUserData(geometry, &g);
        if (material.alphaCutoff > 0.0F) {
            rtcSetGeometryIntersectFilterFunction(geometry, passCutOut);
            rtcSetGeometryOccludedFilterFunction(geometry, passCutOut);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(hierarchy, geometry, g.instance);
        check("adding a mesh");
    }
};

RayScene::RayScene(const Scene& scene) : state_(new State{scene, {}, nullptr, nullptr}) {
    state_->device = rtcNewDevice(nullptr);
    if (state_->device == nullptr) {
        const RTCError error = rtcGetDeviceError(nullptr);
        fail("starting Embree: {} (error {})", embreeText(error), static_cast<int>(error));
    }
    state_->hierarchy = rtcNewScene(state_->device);
    // Robust: rays do not leak between adjacent triangles.
    rtcSetSceneFlags(state_->hierarchy, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | filterFlag));
    state_->geometries.resize(scene.instances.size());
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        EmbreeGeometry& g = state_->geometries[i];
        g.owner = this;
        g.instance = i;
        if (!scene.meshes.at(scene.instances[i].mesh).indices.empty()) {
            state_->add(g);
        }
    }
    rtcCommitScene(state_->hierarchy);
    state_->check("building the BVH");
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::intersect(const Ray& ray, RayKind kind) const {
    if (!isTraceable(ray)) {
        return std::nullopt;
    }
    RTCRayHit r{};
    r.ray = embreeRay(ray);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Query(kind).intersect(state_->hierarchy, r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return Hit{r.ray.tfar, r.hit.geomID, r.hit.primID, {r.hit.u, r.hit.v}};
}

bool RayScene::occluded(const Ray& ray, RayKind kind) const {
    if (!isTraceable(ray)) {
        return false;
    }
    RTCRay r = embreeRay(ray);
    Query(kind).occluded(state_->hierarchy, r);
    return r.tfar < 0.0F;
}

const Scene& RayScene::scene() const {
    return state_->scene;
}

Triangle RayScene::triangle(uint32_t instance, uint32_t triangle) const {
    const vec3* positions = state_->geometries[instance].positions;
    const Mesh& mesh = state_->scene.meshes[state_->scene.instances[instance].mesh];
    const uint32_t* indices = &mesh.indices[size_t(triangle) * 3];
    return {positions[indices[0]], positions[indices[1]], positions[indices[2]]};
}

const Material& RayScene::material(uint32_t instance) const {
    return state_->scene.materials[state_->scene.meshes[state_->scene.instances[instance].mesh].material];
}

const mat3& RayScene::normalToWorld(uint32_t instance) const {
    return state_->geometries[instance].normalToWorld;
}

bool RayScene::mirrored(uint32_t instance) const {
    return state_->geometries[instance].mirrored;
}

}  // namespace reflet
