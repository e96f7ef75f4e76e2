// Runs a GLSL function on the device: one thread per input, one output each.
//
// A test shader `x_test.comp` binds, by name, `params` (uniform block, where it has one), `inputs` (readonly buffer)
// and `outputs` (buffer), all in scalar layout, and calls the function under test.
#pragma once

#include "support/device_fixture.h"

#include <functional>
#include <ranges>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::test {

struct NoParams {};

class ShaderTest : public DeviceTest {
protected:
    /// Outputs of `shader` for all inputs. `bind` binds what else the pass reads.
    template <class Out, std::ranges::contiguous_range Inputs, class Params = NoParams>
    static std::vector<Out> mapOnDevice(std::string_view shader, const Inputs& inputs, const Params& params = {},
                                        const std::function<void(gpu::ComputePass&)>& bind = {}) {
        static_assert(std::is_trivially_copyable_v<Out>);
        std::vector<Out> outputs(std::ranges::size(inputs));
        std::span<const std::byte> block;
        if constexpr (!std::is_same_v<Params, NoParams>) {
            static_assert(std::is_trivially_copyable_v<Params>);
            block = std::as_bytes(std::span(&params, 1));
        }
        runShader(shader, {.inputs = std::as_bytes(std::span(inputs)),
                           .params = block,
                           .outputs = std::as_writable_bytes(std::span(outputs)),
                           .threads = static_cast<uint32_t>(outputs.size()),
                           .bind = bind});
        return outputs;
    }

    /// For tests that record their own passes.
    static void registerTestShaders();
    /// Records and runs a frame.
    static void record(const std::function<void(gpu::Frame&)>& passes);

private:
    struct Io {
        std::span<const std::byte> inputs;
        std::span<const std::byte> params;  ///< empty if the shader has none
        std::span<std::byte> outputs;
        uint32_t threads = 0;
        const std::function<void(gpu::ComputePass&)>& bind;
    };
    static void runShader(std::string_view shader, const Io& io);
};

}  // namespace reflet::test
