// Guarantees of the GPU layer: a pass that does not match its shader is rejected with a name, histories swap.
#include "base/error.h"
#include "device/frame.h"
#include "effects/tonemap/tonemap.h"
#include "gpu/pipeline.h"
#include "gpu/shader.h"
#include "pass/harness.h"
#include "reflection/reflect_shader.h"
#include "renderer/shaders.h"
#include "support/device_fixture.h"

#include <functional>

namespace reflet::test::gpu_test {
namespace {

class Gpu : public DeviceTest {
protected:
    static constexpr uvec2 size{8, 4};

    gpu::KeptImage radiance_{"radiance"};
    gpu::KeptImage display_{"display"};

    gpu::Image radiance(gpu::Frame& f) { return radiance_.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, size); }
    gpu::Image display(gpu::Frame& f) { return display_.storage(f, VK_FORMAT_R8G8B8A8_UNORM, size); }

    void recordTonemap(gpu::Frame& f) {
        f.clear(radiance(f));
        f.compute("tonemap", "tonemap.comp")
            .read("radiance", radiance(f))
            .write("display", display(f))
            .params(TonemapParams{{}, size})
            .dispatch(size);
    }

    // The error message of a pass that is recorded in a frame that is never submitted.
    static std::string complaint(const std::function<void(gpu::Frame&)>& record) {
        gpu::Frame f(device());
        f.begin();
        try {
            record(f);
        } catch (const std::logic_error& error) {
            f.submit();
            f.wait();
            return error.what();
        }
        f.submit();
        f.wait();
        return "";
    }
};

TEST_F(Gpu, APassThatFitsIsRecorded) {
    EXPECT_EQ(complaint([&](gpu::Frame& f) { recordTonemap(f); }), "");
}

TEST_F(Gpu, AnUnknownBindingIsNamed) {
    const std::string text = complaint([&](gpu::Frame& f) {
        f.compute("tonemap", "tonemap.comp")
            .read("radiance", radiance(f))
            .read("radiancy", radiance(f))
            .write("display", display(f))
            .params(TonemapParams{{}, size})
            .dispatch(size);
    });
    EXPECT_NE(text.find("tonemap: the shader has no binding 'radiancy'"), std::string::npos) << text;
}

TEST_F(Gpu, AMissingBindingIsNamed) {
    const std::string text = complaint([&](gpu::Frame& f) {
        f.compute("tonemap", "tonemap.comp")
            .read("radiance", radiance(f))
            .params(TonemapParams{{}, size})
            .dispatch(size);
    });
    EXPECT_NE(text.find("tonemap: nothing is bound to 'display'"), std::string::npos) << text;
}

TEST_F(Gpu, AParameterBlockOfAnotherSizeIsNamedWithBothSizes) {
    const std::string text = complaint([&](gpu::Frame& f) {
        f.compute("tonemap", "tonemap.comp")
            .read("radiance", radiance(f))
            .write("display", display(f))
            .params(1.0F)
            .dispatch(size);
    });
    EXPECT_NE(text.find("'params' has"), std::string::npos) << text;
    EXPECT_NE(text.find(fmt::format("{} in the shader", sizeof(TonemapParams))), std::string::npos) << text;
}

TEST_F(Gpu, WritingWhatTheShaderOnlyReadsIsRefused) {
    const std::string text = complaint([&](gpu::Frame& f) {
        f.compute("tonemap", "tonemap.comp")
            .write("radiance", radiance(f))
            .write("display", display(f))
            .params(TonemapParams{{}, size})
            .dispatch(size);
    });
    EXPECT_NE(text.find("'radiance' is written here, and readonly in the shader"), std::string::npos) << text;
}

TEST_F(Gpu, AnUnknownSpecializationConstantIsNamed) {
    const std::string text = complaint([&](gpu::Frame& f) {
        f.compute("tonemap", "tonemap.comp")
            .constant("quality", 3)
            .read("radiance", radiance(f))
            .write("display", display(f))
            .params(TonemapParams{{}, size})
            .dispatch(size);
    });
    EXPECT_NE(text.find("no specialization constant 'quality'"), std::string::npos) << text;
}

TEST_F(Gpu, HistoryIsLastFramesImageAndStartsAnewWithASize) {
    gpu::Frame f(device());
    gpu::HistoryImage images("test.history");
    const auto next = [&](uvec2 extent) {
        f.begin();
        const gpu::History history = images.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, extent);
        const gpu::History again = images.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, extent);
        EXPECT_EQ(again.valid, history.valid);
        EXPECT_EQ(again.next.state, history.next.state);
        f.clear(history.next);
        f.submit();
        f.wait();
        return history;
    };
    const gpu::History first = next(size);
    const gpu::History second = next(size);
    EXPECT_FALSE(first.valid);
    EXPECT_TRUE(second.valid);
    EXPECT_EQ(second.previous.state, first.next.state);
    EXPECT_NE(second.next.state, first.next.state);
    EXPECT_FALSE(next({4, 4}).valid);
    f.begin();  // a frame that does not ask for it breaks the chain
    f.submit();
    f.wait();
    EXPECT_FALSE(next({4, 4}).valid);
}

TEST_F(Gpu, TimesAreThereForEveryPassByItsScopedName) {
    gpu::Frame f(device());
    f.begin();
    {
        const auto scope = f.scope("outer");
        f.clear(radiance(f));
        f.keep(tonemap(f, radiance(f), {}));
    }
    f.submit();
    f.wait();
    ASSERT_EQ(f.passTimes().size(), 2U);
    EXPECT_EQ(f.passTimes()[0].name, "frame");
    EXPECT_EQ(f.passTimes()[1].name, "outer.tonemap");
    EXPECT_GT(f.passTimes()[1].ms, 0.0);
}

// Compiling takes seconds on some drivers, so it is announced, and its end is that of the first frame with what was
// compiled.
TEST_F(Gpu, TellsWhatIsCompiledAndWhenItWasUsed) {
    std::vector<uint32_t> told;
    gpu::Device device({.shaders = {effectShaders()}, .onCompile = [&](uint32_t shaders) { told.push_back(shaders); }});
    gpu::Frame f(device);
    gpu::KeptImage radiance("radiance");
    gpu::KeptImage display("display");
    const auto render = [&] {
        f.begin();
        const gpu::Image from = radiance.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, size);
        const gpu::Image to = display.storage(f, VK_FORMAT_R8G8B8A8_UNORM, size);
        f.clear(from);
        for (const char* name : {"tonemap", "again"}) {
            f.compute(name, "tonemap.comp")
                .read("radiance", from)
                .write("display", to)
                .params(TonemapParams{{}, size})
                .dispatch(size);
        }
        f.submit();
        f.wait();
    };
    render();
    render();
    EXPECT_EQ(told, (std::vector<uint32_t>{1, 0}));
}

TEST_F(Gpu, AShaderIsReplacedOnlyByOneThatBindsTheSame) {
    const gpu::Shader known = device().shaders().find("tonemap.comp");
    const std::vector<uint32_t> same(known.words.begin(), known.words.end());
    const gpu::Shader other = device().shaders().find("composite.comp");
    const auto replace = [&](std::string_view name, std::vector<uint32_t> words) {
        device().shaders().replace(reflection::reflectShader(name, std::move(words)));
    };
    EXPECT_THROW(replace("tonemap.comp", {other.words.begin(), other.words.end()}), Error);
    EXPECT_EQ(device().shaders().find("tonemap.comp").words.data(), known.words.data()) << "the old one is kept";
    replace("tonemap.comp", same);
    EXPECT_NE(device().shaders().find("tonemap.comp").words.data(), known.words.data());
    device().pipelines().clear();
    EXPECT_EQ(complaint([&](gpu::Frame& f) { recordTonemap(f); }), "");
}

}  // namespace
}  // namespace reflet::test::gpu_test
