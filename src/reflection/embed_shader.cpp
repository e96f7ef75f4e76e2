// embed_shader NAME IN.spv OUT.inc: writes a shader and its interface as constants of C++. A step of the build.
#include "reflection/reflect_shader.h"

#include "base/error.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace reflet::gpu;

std::vector<uint32_t> readWords(const char* path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (bytes.empty() || bytes.size() % sizeof(uint32_t) != 0) {
        reflet::fail("{}: not SPIR-V", path);
    }
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

// An empty span has no array.
template <class Item, class Print>
std::string array(const char* type, const std::string& symbol, std::span<const Item> items, Print print) {
    if (items.empty()) {
        return fmt::format("constexpr std::span<const {}> {};\n", type, symbol);
    }
    std::string text = fmt::format("constexpr {} {}[] = {{\n", type, symbol);
    for (const Item& item : items) {
        text += print(item);
    }
    return text + "};\n";
}

std::string printed(const Shader& shader) {
    std::string text = array("uint32_t", "words", shader.words, [column = 0](uint32_t word) mutable {
        return fmt::format("{},{}", word, ++column % 16 == 0 ? "\n" : "");
    });
    text += array("reflet::gpu::ShaderBinding", "bindings", shader.bindings, [](const ShaderBinding& b) {
        return fmt::format("{{\"{}\", {}, {}, {}, VkDescriptorType({}), {}, {}, VkFormat({})}},\n", b.name, b.set,
                           b.binding, b.count, int(b.type), b.readOnly, b.blockSize, int(b.format));
    });
    text += array("reflet::gpu::SpecializationConstant", "constants", shader.constants,
                  [](const SpecializationConstant& c) { return fmt::format("{{\"{}\", {}}},\n", c.name, c.id); });
    const auto location = [](const ShaderLocation& l) { return fmt::format("{{\"{}\", {}}},\n", l.name, l.location); };
    text += array("reflet::gpu::ShaderLocation", "inputs", shader.inputs, location);
    text += array("reflet::gpu::ShaderLocation", "outputs", shader.outputs, location);
    return text + fmt::format(
                      "constexpr reflet::gpu::Shader shader{{\"{}\", words, VkShaderStageFlagBits({}), bindings, "
                      "constants, inputs, outputs, {}, glm::uvec3({}, {}, {})}};\n",
                      shader.name, int(shader.stage), shader.pushConstantSize, shader.localSize.x, shader.localSize.y,
                      shader.localSize.z);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) {
        std::fputs("usage: embed_shader NAME IN.spv OUT.inc\n", stderr);
        return 2;
    }
    try {
        const ReflectedShader reflected = reflet::reflection::reflectShader(arguments[1], readWords(arguments[2]));
        std::ofstream out(arguments[3]);
        out << printed(reflected.shader);
        out.close();
        if (!out) {
            reflet::fail("{}: cannot be written", arguments[3]);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "embed_shader: {}\n", error.what());
        return 1;
    }
    return 0;
}
