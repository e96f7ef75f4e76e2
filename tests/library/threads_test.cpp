// Two contexts, four views, and eight threads that make random legal calls, on a driver that executes nothing:
// ThreadSanitizer finds races, the driver what is destroyed while it is in use. REFLET_THREADS: seconds.
#include "library/library_host.h"
#include "stub/host.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

namespace reflet::test::threads_test {
namespace {

constexpr uint32_t contextCount = 2;
constexpr uint32_t viewCount = 4;
constexpr uint32_t threadCount = 8;
constexpr uint32_t framesInFlight = 2;

struct SharedView {
    std::atomic<RefletView> view = nullptr;
    std::mutex frame;  ///< of who records its frames, resizes or destroys it
    uint32_t index = 0;
    uint32_t width = 64;
    std::vector<VkCommandBuffer> commands;

    void finish(size_t left) {
        for (; commands.size() > left; commands.erase(commands.begin())) {
            stub::finishCommands(commands.front());
        }
    }
};

struct Shared {
    std::array<RefletContext, contextCount> contexts{};
    std::array<RefletRadianceCache, contextCount> caches{};  ///< of the views of a context
    std::array<SharedView, viewCount> views;
    std::atomic<uint64_t> frames = 0;
    std::atomic<uint64_t> queries = 0;
    std::atomic<uint64_t> destroyed = 0;

    void make(uint32_t i) {
        SharedView& shared = views.at(i);
        const RefletViewInfo info{sizeof info, 64, 40, framesInFlight, REFLET_VIEW_PASS_TIMES, i};
        RefletView made = nullptr;
        EXPECT_REFLET(refletCreateView(contexts.at(i % contextCount), &info, &made));
        shared.width = 64;
        shared.view = made;
    }
};

class Worker {
public:
    Worker(Shared& shared, uint32_t seed) : shared_(shared), random_(seed) {
        constexpr std::array<const char*, 3> presets{"fast", "balanced", "quality"};
        EXPECT_REFLET(refletCreateSettings(presets.at(seed % presets.size()), &settings_));
        EXPECT_REFLET(refletSetSetting(settings_, "ao.method", seed % 2 == 0 ? "horizon" : "bitmask"));
    }
    ~Worker() { refletDestroySettings(settings_); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void step() {
        const uint32_t i = random_() % viewCount;
        SharedView& view = shared_.views.at(i);
        std::unique_lock frame(view.frame, std::try_to_lock);
        if (!frame) {
            return ask(view.view, i);  // while another thread records, resizes or destroys it
        }
        switch (random_() % 16) {
            case 0:
                view.finish(0);
                refletDestroyView(view.view);
                ++shared_.destroyed;
                return shared_.make(i);
            case 1:
                view.width = 48 + 4 * (random_() % 8);
                EXPECT_REFLET(refletResizeView(view.view, view.width, 40));
                return;
            case 2:
                view.finish(0);
                EXPECT_REFLET(refletFinishView(view.view));
                return;
            case 3:
                return prepare(view);
            default:
                record(view, i);
        }
    }

private:
    // Whatever it is doing, or if it is gone: the answer is a result.
    void ask(RefletView view, uint32_t i) {
        uint64_t bytes = 0;
        std::array<char, 2000> text{};
        size_t size = text.size();
        RefletImage image{};
        std::array<RefletPassTime, 8> times{};
        uint32_t count = times.size();
        RefletResult result = REFLET_SUCCESS;
        switch (random_() % 8) {
            case 7:
                result = refletResetRadianceCache(shared_.caches.at(i % contextCount));
                break;
            case 0:
                result = refletViewMemory(view, &bytes);
                break;
            case 1:
                result = refletDescribe(view, &size, text.data());
                break;
            case 2:
                result = refletFindImage(view, "light", &image);
                break;
            case 3:
                result = refletPassTimes(view, &count, times.data());
                break;
            case 4:
                result = refletContextMemory(shared_.contexts.at(i % contextCount), &bytes);
                break;
            case 5:
                result = refletPipelineCacheData(shared_.contexts.at(i % contextCount), &size, text.data());
                break;
            default:
                result = refletResetView(view);
        }
        EXPECT_TRUE(result == REFLET_SUCCESS || result == REFLET_ERROR_INVALID_ARGUMENT) << refletLastError();
        ++shared_.queries;
    }

    void prepare(const SharedView& view) {
        stub::HostFrame host(view.width, 40);
        host.prepare.effects &= random_() | 1U;
        uint32_t remaining = 0;
        EXPECT_REFLET(refletPrepare(view.view, settings_, &host.prepare, 2, &remaining));
    }

    void record(SharedView& shared, uint32_t i) {
        RefletView view = shared.view;
        stub::HostFrame host(shared.width, 40);
        host.light.radianceCache = shared_.caches.at(i % contextCount);
        host.look(0.01F * static_cast<float>(shared.index));
        shared.finish(framesInFlight - 1);
        shared.commands.push_back(stub::beginCommands());
        host.frame.commandBuffer = shared.commands.back();
        host.frame.frameIndex = shared.index++;
        EXPECT_REFLET(refletBeginFrame(view, &host.frame));
        const uint32_t effects = random_();
        const auto has = [&](uint32_t which) { return (effects >> which & 1U) != 0; };
        RefletImage image{};
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        if (has(0)) {
            EXPECT_REFLET(refletSunShadow(view, settings_, &host.sun, &image));
        }
        if (has(1)) {
            EXPECT_REFLET(refletLampShadows(view, settings_, host.lamps.data(), 1 + effects % 3, &image));
        }
        if (has(2)) {
            EXPECT_REFLET(refletAmbientOcclusion(view, settings_, &image));
        }
        if (has(3)) {
            EXPECT_REFLET(refletDiffuseGi(view, settings_, &host.light, &lobe));
        }
        if (has(4)) {
            EXPECT_REFLET(refletReflections(view, settings_, &host.light, &lobe));
        }
        EXPECT_REFLET(refletComposite(view, settings_, &host.color, &sum));
        if (has(5)) {
            EXPECT_REFLET(refletTemporal(view, settings_, nullptr, &image));
        }
        EXPECT_REFLET(refletToneMap(view, settings_, nullptr, effects >> 6U & 1U, &image));
        EXPECT_REFLET(refletEndFrame(view));
        ++shared_.frames;
    }

    Shared& shared_;
    std::mt19937 random_;
    RefletSettings settings_ = nullptr;
};

TEST(Threads, RandomCallsOnSharedViews) {
    const char* const asked = std::getenv("REFLET_THREADS");  // NOLINT(concurrency-mt-unsafe): before there are threads
    const auto seconds = std::chrono::seconds(asked == nullptr ? 0 : std::strtol(asked, nullptr, 10));
    constexpr uint32_t leastSteps = 40;
    stub::setDevice({});
    Shared shared;
    for (uint32_t i = 0; i < contextCount; ++i) {
        const RefletContextInfo info = stub::contextInfo();
        EXPECT_REFLET(refletCreateContext(&info, &shared.contexts.at(i)));
        EXPECT_REFLET(refletCreateRadianceCache(shared.contexts.at(i), &shared.caches.at(i)));
    }
    for (uint32_t i = 0; i < viewCount; ++i) {
        shared.make(i);
    }
    {
        std::vector<std::jthread> threads;
        for (uint32_t i = 0; i < threadCount; ++i) {
            threads.emplace_back([&shared, seconds, seed = i + 1] {
                Worker worker(shared, seed);
                const auto end = std::chrono::steady_clock::now() + seconds;
                for (uint32_t step = 0; step < leastSteps || std::chrono::steady_clock::now() < end; ++step) {
                    worker.step();
                }
            });
        }
    }
    for (SharedView& view : shared.views) {
        view.finish(0);
        refletDestroyView(view.view);
    }
    for (RefletRadianceCache cache : shared.caches) {
        refletDestroyRadianceCache(cache);
    }
    for (RefletContext context : shared.contexts) {
        refletDestroyContext(context);
    }
    EXPECT_EQ(stub::leaks(), "");
    EXPECT_GT(shared.frames, 0U);
    std::printf("%llu frames, %llu queries, %llu views destroyed\n", static_cast<unsigned long long>(shared.frames),
                static_cast<unsigned long long>(shared.queries), static_cast<unsigned long long>(shared.destroyed));
}

}  // namespace
}  // namespace reflet::test::threads_test
