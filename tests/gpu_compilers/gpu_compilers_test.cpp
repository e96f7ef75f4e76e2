// What a GPU's compiler makes of the library's pipelines, on machines without that GPU: Mesa's compiler for AMD GPUs,
// by its null device. Frames of the presets and of what these leave off are recorded, and nothing is executed.
#include "gpu_compilers/frames.h"
#include "gpu_compilers/limits.h"
#include "gpu_compilers/null_device.h"
#include "gpu_compilers/statistics.h"

#include "base/file.h"
#include "gpu/context.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include <unistd.h>

std::span<const reflet::gpu::Shader> effectShaders();
std::span<const reflet::gpu::Shader> rendererShaders();

namespace reflet::gpu_compilers {
namespace {

// Threads of the programs that run these tests have not begun.
const char* environment(const char* name) {
    return std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
}

// The kernels of the program's renderer, which the library has not, and of its lamps: with the default of each
// constant, and with 1 for each. Not what asks the device's own ray tracing, which this one has not.
void compileRenderer(const gpu::OpenDevice& device) {
    gpu::Context context(device);
    context.shaders().add(effectShaders());
    context.shaders().add(rendererShaders());
    std::vector<gpu::Shader> wanted{context.shaders().find("lamp_visibility.comp")};
    std::ranges::copy(rendererShaders(), std::back_inserter(wanted));
    for (const gpu::Shader& shader : wanted) {
        if (shader.stage != VK_SHADER_STAGE_COMPUTE_BIT || shader.name.ends_with("_query.comp")) {
            continue;
        }
        gpu::PipelineInfo info{.shaders = {shader.name}};
        context.pipelines().get(info);
        for (const gpu::SpecializationConstant& constant : shader.constants) {
            if (constant.name != "endsInProbes" && constant.name != "environmentIsOneColor") {
                info.constants.emplace_back(constant.name, 1U);
            }
        }
        if (!info.constants.empty()) {
            context.pipelines().get(info);
        }
    }
}

const std::filesystem::path limitsFile = REFLET_GPU_LIMITS_FILE;

/// One compilation of all pipelines for all tests: it takes most of the time.
class GpuCompilers : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        const NullDevice* device = NullDevice::get();
        if (device == nullptr || !frames.empty()) {
            return;
        }
        const RefletContextInfo info = device->contextInfo();
        RefletContext context = nullptr;
        ASSERT_EQ(refletCreateContext(&info, &context), REFLET_SUCCESS) << refletLastError();
        for (const FrameCase& wanted : frameCases()) {
            frames[wanted.name] = recordSteadyFrame(context, wanted);
        }
        compileRenderer(device->open());
        if (const char* file = environment("REFLET_GPU_STATISTICS")) {
            writeStatistics(file, device->driver(), frames);
        }
        refletDestroyContext(context);
    }

    void SetUp() override {
        if (NullDevice::get() == nullptr) {
            GTEST_SKIP() << "Mesa's driver for AMD GPUs has no null device here (Debian: mesa-vulkan-drivers)";
        }
        ASSERT_FALSE(recordedKernels().empty());
    }

    static std::map<std::string, RecordedFrame> frames;
};

std::map<std::string, RecordedFrame> GpuCompilers::frames;

// Memory of its own for each lane costs bandwidth where nobody expects it; a group with more shared memory than that
// shares its unit with few others.
TEST_F(GpuCompilers, NoKernelSpillsOrHasScratchMemory) {
    for (const auto& [name, kernel] : recordedKernels()) {
        EXPECT_EQ(kernel.statistics.at("Scratch size"), 0U) << name;
        EXPECT_EQ(kernel.statistics.at("Spilled VGPRs"), 0U) << name;
        // Of paths through the scene, which bind 30 resources: the compiler keeps their descriptors in lanes of vector
        // registers.
        const uint64_t spilled = name.starts_with("trace_scene.comp") ? 64 : 0;
        EXPECT_LE(kernel.statistics.at("Spilled SGPRs"), spilled) << name;
        EXPECT_LE(kernel.statistics.at("LDS size"), 16384U) << name;
    }
}

TEST_F(GpuCompilers, KernelsCostNoMoreThanInTheTable) {
    const std::string driver = NullDevice::get()->driver();
    if (environment("REFLET_GPU_LIMITS") != nullptr) {
        Limits made{driver, {}};
        for (const auto& [name, kernel] : recordedKernels()) {
            const KernelCost cost = costOf(kernel);
            if (cost.instructions >= leastInstructions) {
                made.kernels[name] = cost;
            }
        }
        writeLimits(limitsFile, made);
        GTEST_SKIP() << "written: " << limitsFile;
    }
    const Limits limits = readLimits(limitsFile);
    ASSERT_GT(limits.kernels.size(), 20U);
    for (const std::string& line : exceeded(limits, recordedKernels(), limits.driver == driver ? 0.05 : 0.10)) {
        ADD_FAILURE() << line;
    }
}

// The table is only worth something if what it is compared with sees a change.
TEST_F(GpuCompilers, TheTableFindsWhatCostsMore) {
    const Kernel& kernel = recordedKernels().begin()->second;
    Limits limits{"", {{kernel.name, costOf(kernel)}}};
    const std::map<std::string, Kernel> one{{kernel.name, kernel}};
    EXPECT_TRUE(exceeded(limits, one, 0.05).empty());
    limits.kernels[kernel.name].instructions = limits.kernels[kernel.name].instructions * 9 / 10;
    limits.kernels[kernel.name].occupancy += 1;
    limits.kernels["gone.comp"] = {};
    EXPECT_EQ(exceeded(limits, one, 0.05).size(), 3U);
}

TEST_F(GpuCompilers, FramesHaveThePassesOfTheirPresets) {
    const auto has = [&](const char* frame, std::string_view shader) {
        return std::ranges::any_of(frames.at(frame).passes,
                                   [&](const RecordedPass& pass) { return pass.kernel.starts_with(shader); });
    };
    for (const char* preset : {"fast", "balanced", "quality"}) {
        EXPECT_TRUE(has(preset, "dof_gather.comp")) << preset;
        EXPECT_TRUE(has(preset, "denoise_gather.comp")) << preset;
        EXPECT_TRUE(has(preset, "shadow_visibility_host.comp")) << preset;
    }
    EXPECT_TRUE(has("balanced", "trace_screen.comp"));
    EXPECT_TRUE(has("quality", "trace_at_once.comp"));
    EXPECT_TRUE(has("options", "shadow_visibility_layers.comp"));
    EXPECT_TRUE(has("options", "finish_ao.comp"));
}

// ---- what needs no driver ------------------------------------------------------------------------------------------

// A loop within a loop, as the compiler prints them: what is between is not of the inner one.
TEST(GpuAssembly, LoopsAreFoundWithTheirInstructions) {
    const std::vector<Loop> loops = loopsOf(
        "BB0:\n\tv_mov_b32_e32 v0, 0 ; 7e000280\n\ts_load_dwordx4 s[0:3], s[4:5], 0x0\n"
        "BB1:\n\tv_add_f32_e32 v0, v0, v1\n"
        "BB2:\n\timage_sample v1, v[0:1], s[0:7]\n\ts_waitcnt vmcnt(0)\n\tv_rcp_f32_e32 v1, v1\n\ts_cbranch_scc1 BB2   "
        "; bf85fff0\n"
        "BB3:\n\ts_branch BB1\n"
        "BB4:\n\timage_load v4, v[0:1], s[0:7]\n\timage_load v5, v[2:3], s[0:7]\n\ts_waitcnt vmcnt(1)\n\ts_waitcnt "
        "vmcnt(0)\n"
        "BB5:\n\timage_store v0, v[2:3], s[0:7]\n\ts_endpgm\n");
    ASSERT_EQ(loops.size(), 3U);
    EXPECT_EQ(loops[0].instructions.vector, 1U);
    EXPECT_EQ(loops[0].instructions.constants, 1U);
    EXPECT_EQ(loops[0].instructions.stores, 1U);
    EXPECT_EQ(loops[0].instructions.memoryWaits, 1U) << "both loads were under way";
    EXPECT_EQ(loops[1].parent, 0);
    EXPECT_FALSE(loops[1].innermost);
    EXPECT_EQ(loops[1].instructions.sum(), 2U);
    EXPECT_EQ(loops[2].parent, 1);
    EXPECT_EQ(loops[2].instructions.samples, 1U);
    EXPECT_EQ(loops[2].instructions.transcendental, 1U);
    EXPECT_EQ(loops[2].instructions.memoryWaits, 1U);
    EXPECT_EQ(innerLoop(loops), 3U);
}

// glslc's output, and that it is what other tools take for valid: drivers need not check.
TEST(GpuShaders, AreValidSpirV) {
    if (std::system("spirv-val --version >/dev/null 2>&1") != 0) {  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
        GTEST_SKIP() << "there is no spirv-val (Debian: spirv-tools)";
    }
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("reflet-shaders-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    for (const gpu::Shader& shader : effectShaders()) {
        const std::filesystem::path file = folder / std::string(shader.name);
        const auto* bytes = reinterpret_cast<const char*>(shader.words.data());
        writeFileAtomically(file, std::string(bytes, shader.words.size_bytes()), Lasting::no);
        const std::string command = "spirv-val --target-env vulkan1.3 --scalar-block-layout '" + file.string() + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << shader.name;  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace reflet::gpu_compilers
