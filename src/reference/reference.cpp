// Renders the reference in passes over tiles. Pixels are independent, so that the number of threads does not change the
// result.
#include "reference/reference.h"

#include "base/color.h"
#include "base/error.h"
#include "compare/octaves.h"
#include "reference/parallel.h"
#include "reference/path_tracer.h"
#include "scene/pose.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>

namespace reflet {

namespace {

constexpr uint32_t tileSize = 16;
constexpr uint32_t largestPass = 16;  // samples per pixel between two noise estimates

struct PixelSum {
    vec3 direct{0.0F};
    vec3 indirectDiffuse{0.0F};
    vec3 indirectSpecular{0.0F};
    vec3 albedo{0.0F};
    float sunVisibility = 0.0F;
    float ambientVisibility = 0.0F;
    uint32_t covered = 0;
    uint32_t count = 0;
    double luminance = 0.0;
    double luminanceSquared = 0.0;

    void add(const PathSample& s) {
        direct += s.direct;
        indirectDiffuse += s.indirectDiffuse;
        indirectSpecular += s.indirectSpecular;
        albedo += s.albedo;
        sunVisibility += s.sunVisibility;
        ambientVisibility += s.ambientVisibility;
        covered += s.background ? 0 : 1;
        ++count;
        const double l = reflet::luminance(s.direct + s.indirectDiffuse + s.indirectSpecular);
        luminance += l;
        luminanceSquared += l * l;
    }

    // Of the mean, assuming independent samples; low-discrepancy samples do better.
    [[nodiscard]] double relativeVariance(double floor) const {
        const double n = count;
        const double mean = luminance / n;
        const double variance = std::max(luminanceSquared / n - mean * mean, 0.0) / (n - 1.0);
        return variance / (mean * mean + floor);
    }
};

// Both lobes by one factor, so that their hue and their shares stay.
void limit(PathSample& sample, float most) {
    const float bright = luminance(sample.indirectDiffuse + sample.indirectSpecular);
    if (most > 0.0F && bright > most) {
        sample.indirectDiffuse *= most / bright;
        sample.indirectSpecular *= most / bright;
    }
}

class Tracing {
public:
    using Proceed = std::function<bool(const ReferenceProgress&)>;

    Tracing(const PathTracer& tracer, uvec2 size, const ReferenceOptions& options, const Proceed& proceed)
        : tracer_(tracer), size_(size), options_(options), proceed_(proceed), sums_(size_t(size.x) * size.y) {
        progress_.total = uint64_t(options.samples) * sums_.size();
    }

    // Until the sample count or the noise limit is reached, or the caller stops it.
    void run() {
        uint32_t done = 0;
        while (done < options_.samples && !stopped_) {
            const uint32_t count = std::min({std::max(done, 1U), largestPass, options_.samples - done});
            tracePass(done, count);
            done += count;
            progress_.noise = noise();
            if (done > 1 && options_.noise > 0.0F && !(progress_.noise >= options_.noise)) {
                break;
            }
        }
    }

    [[nodiscard]] const std::vector<PixelSum>& sums() const { return sums_; }
    [[nodiscard]] uint64_t rays() const { return rays_; }
    [[nodiscard]] bool stopped() const { return stopped_; }

    [[nodiscard]] double noise() const {
        std::vector<float> means;
        for (const PixelSum& pixel : sums_) {
            if (pixel.count < 2) {
                return 0.0;
            }
            means.push_back(static_cast<float>(pixel.luminance / pixel.count));
        }
        const double floor = relativeErrorFloorFor(std::move(means));
        double sum = 0.0;
        for (const PixelSum& pixel : sums_) {
            sum += pixel.relativeVariance(floor);
        }
        return std::sqrt(sum / static_cast<double>(sums_.size()));
    }

private:
    void tracePass(uint32_t first, uint32_t count) {
        const uvec2 tiles = (size_ + tileSize - 1U) / tileSize;
        parallelFor(tiles.x * tiles.y, [&](uint32_t tile) {
            if (stopped_ && first > 0) {
                return;
            }
            traceTile(uvec2(tile % tiles.x, tile / tiles.x) * tileSize, first, count);
        });
    }

    void traceTile(uvec2 corner, uint32_t first, uint32_t count) {
        const uvec2 end = glm::min(corner + tileSize, size_);
        uint64_t rays = 0;
        for (uint32_t y = corner.y; y < end.y; ++y) {
            for (uint32_t x = corner.x; x < end.x; ++x) {
                PixelSum& sum = sums_[size_t(y) * size_.x + x];
                for (uint32_t i = first; i < first + count; ++i) {
                    const PixelSampler random(y * size_.x + x, options_.seed, options_.firstSample + i);
                    const vec2 inside = options_.filter == PixelFilter::center ? vec2(0.5F) : random.pair(0);
                    PathSample sample = tracer_.trace(vec2(x, y) + inside, random);
                    limit(sample, options_.clamp);
                    sum.add(sample);
                    rays += sample.rays;
                }
            }
        }
        rays_ += rays;
        report(uint64_t(count) * (end.x - corner.x) * (end.y - corner.y));
    }

    void report(uint64_t samples) {
        const std::lock_guard lock(mutex_);
        progress_.done += samples;
        if (proceed_ && !proceed_(progress_)) {
            stopped_ = true;
        }
    }

    const PathTracer& tracer_;
    uvec2 size_;
    const ReferenceOptions& options_;
    const Proceed& proceed_;
    std::vector<PixelSum> sums_;
    std::atomic<uint64_t> rays_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;
    ReferenceProgress progress_;
};

const std::vector<std::string> rgb{"R", "G", "B"};
const std::vector<std::string> xyz{"X", "Y", "Z"};
const std::vector<std::string> grey{"Y"};

FloatImage makeImage(uvec2 size, const std::vector<std::string>& channels) {
    return {size.x, size.y, channels, std::vector<float>(size_t(size.x) * size.y * channels.size())};
}

FloatImage meanColor(uvec2 size, const std::vector<PixelSum>& sums, vec3 PixelSum::*member) {
    FloatImage image = makeImage(size, rgb);
    for (size_t i = 0; i < sums.size(); ++i) {
        const vec3 mean = sums[i].*member / static_cast<float>(sums[i].count);
        std::copy_n(&mean.x, 3, &image.data[3 * i]);
    }
    return image;
}

void gatherMeans(ReferencePicture& picture, uvec2 size, const std::vector<PixelSum>& sums, bool ambient) {
    picture.direct = meanColor(size, sums, &PixelSum::direct);
    picture.indirectDiffuse = meanColor(size, sums, &PixelSum::indirectDiffuse);
    picture.indirectSpecular = meanColor(size, sums, &PixelSum::indirectSpecular);
    picture.albedo = meanColor(size, sums, &PixelSum::albedo);
    picture.final = makeImage(size, rgb);
    for (size_t i = 0; i < picture.final.data.size(); ++i) {
        picture.final.data[i] =
            picture.direct.data[i] + picture.indirectDiffuse.data[i] + picture.indirectSpecular.data[i];
    }
    picture.sunVisibility = makeImage(size, grey);
    picture.coverage = makeImage(size, grey);
    for (size_t i = 0; i < sums.size(); ++i) {
        picture.coverage.data[i] = static_cast<float>(sums[i].covered) / static_cast<float>(sums[i].count);
        picture.sunVisibility.data[i] = sums[i].sunVisibility / static_cast<float>(sums[i].count);
    }
    if (ambient) {
        picture.ambientOcclusion = makeImage(size, grey);
        std::ranges::transform(sums, picture.ambientOcclusion.data.begin(),
                               [](const PixelSum& s) { return s.ambientVisibility / static_cast<float>(s.count); });
    }
    picture.samples = std::ranges::min(sums, {}, &PixelSum::count).count;
}

// Depths and normals at pixel centres: averages over a pixel would belong to no surface.
void traceCenters(ReferencePicture& picture, uvec2 size, const PathTracer& tracer) {
    picture.normal = makeImage(size, xyz);
    picture.depth = makeImage(size, grey);
    parallelFor(size.y, [&](uint32_t y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            if (const auto surface = tracer.firstSurface(vec2(x, y) + 0.5F)) {
                const size_t i = size_t(y) * size.x + x;
                std::copy_n(&surface->normal.x, 3, &picture.normal.data[3 * i]);
                picture.depth.data[i] = tracer.depth(*surface);
            }
        }
    });
}

}  // namespace

std::vector<ImageLayer> ReferencePicture::layers() const {
    std::vector<ImageLayer> all{{"", final},
                                {"final", final},
                                {"direct", direct},
                                {"indirect_diffuse", indirectDiffuse},
                                {"indirect_specular", indirectSpecular},
                                {"albedo", albedo},
                                {"normal", normal},
                                {"depth", depth},
                                {"sun_visibility", sunVisibility}};
    if (!ambientOcclusion.data.empty()) {
        all.push_back({"ambient_occlusion", ambientOcclusion});
    }
    return all;
}

namespace {

// Calls body where it may use that many threads, also more than there are cores; 0: one per core.
template <class Body>
void withThreads(unsigned threads, const Body& body) {
    std::optional<tbb::global_control> allowed;
    if (threads > 0) {
        allowed.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    tbb::task_arena arena(threads > 0 ? static_cast<int>(threads) : tbb::task_arena::automatic);
    arena.execute(body);
}

void traceInto(ReferencePicture& picture, const RayScene& rays, const View& seen, uvec2 size,
               const ReferenceOptions& options, const std::function<bool(const ReferenceProgress&)>& proceed) {
    const PathTracer tracer(rays, seen, size, options);
    (void)ggxAlbedo(1.0F, 1.0F);  // computes its table outside of the measured time
    const auto start = std::chrono::steady_clock::now();
    Tracing tracing(tracer, size, options, proceed);
    tracing.run();
    picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    gatherMeans(picture, size, tracing.sums(), options.ambientOcclusion);
    traceCenters(picture, size, tracer);
    picture.noise = tracing.noise();
    picture.rays = tracing.rays();
    picture.complete = !tracing.stopped();
}

}  // namespace

ReferencePicture traceReference(const Scene& scene, const View& view, uvec2 size, const ReferenceOptions& options,
                                const std::function<bool(const ReferenceProgress&)>& proceed) {
    REFLET_CHECK(size.x > 0 && size.y > 0 && options.samples > 0, "{}x{}, {} samples", size.x, size.y, options.samples);
    ReferencePicture picture;
    withThreads(options.threads, [&] {
        const bool stands = scene.nodes.empty();
        const Scene still = stands ? Scene{} : frozen(scene, view.time);
        const RayScene rays(stands ? scene : still);
        traceInto(picture, rays, posed(view, scene), size, options, proceed);
    });
    return picture;
}

ReferencePicture traceReference(const RayScene& rays, const View& view, uvec2 size, const ReferenceOptions& options,
                                const std::function<bool(const ReferenceProgress&)>& proceed) {
    REFLET_CHECK(size.x > 0 && size.y > 0 && options.samples > 0, "{}x{}, {} samples", size.x, size.y, options.samples);
    ReferencePicture picture;
    withThreads(options.threads, [&] { traceInto(picture, rays, view, size, options, proceed); });
    return picture;
}

}  // namespace reflet
