// Finds shaders by name.
#include "gpu/shader.h"

#include "base/error.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace reflet::gpu {

namespace {

bool haveSameInterface(const Shader& a, const Shader& b) {
    const auto bindingsOf = [](const Shader& shader) {
        std::vector<ShaderBinding> bindings(shader.bindings.begin(), shader.bindings.end());
        std::ranges::sort(bindings, {}, &ShaderBinding::name);
        for (ShaderBinding& binding : bindings) {
            binding.binding = 0;  // numbered by the compiler; the host binds by name
        }
        return bindings;
    };
    const auto namesOf = [](const auto& list) {
        std::vector<std::string_view> names;
        std::ranges::transform(list, std::back_inserter(names), [](const auto& item) { return item.name; });
        std::ranges::sort(names);
        return names;
    };
    return bindingsOf(a) == bindingsOf(b) && namesOf(a.constants) == namesOf(b.constants) &&
           namesOf(a.inputs) == namesOf(b.inputs) && namesOf(a.outputs) == namesOf(b.outputs) &&
           a.pushConstantSize == b.pushConstantSize;
}

}  // namespace

void ShaderLibrary::add(std::span<const Shader> shaders) {
    for (const Shader& shader : shaders) {
        shaders_.emplace(shader.name, shader);
    }
}

void ShaderLibrary::replace(const ReflectedShader& replacement) {
    const Shader& known = find(replacement.shader.name);
    if (!haveSameInterface(known, replacement.shader)) {
        fail(
            "{}: bindings, constants, inputs or outputs differ from the shader that the program was built with; "
            "rebuild "
            "the program",
            known.name);
    }
    owners_.push_back(replacement.owner);
    Shader& kept = shaders_.find(known.name)->second;
    kept = replacement.shader;
}

const Shader& ShaderLibrary::find(std::string_view name) const {
    const auto found = shaders_.find(name);
    REFLET_CHECK(found != shaders_.end(), "no shader is named '{}'", name);
    return found->second;
}

}  // namespace reflet::gpu
