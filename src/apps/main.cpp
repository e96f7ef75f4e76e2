// Entry point: names the shaders and the subcommands.
#include "apps/commands.h"
#include "apps/program.h"
#include "gpu/shader.h"
#include "view/view_command.h"

#include <span>

std::span<const reflet::gpu::EmbeddedShader> refletShaders();
std::span<const reflet::gpu::EmbeddedShader> refletViewShaders();

int main(int argc, char** argv) {
    reflet::gpu::registerShaders(refletShaders());
    reflet::gpu::registerShaders(refletViewShaders());
    constexpr reflet::AddCommand commands[] = {
        reflet::addRenderCommand, reflet::addViewCommand,   reflet::addReferenceCommand, reflet::addCompareCommand,
        reflet::addBenchCommand,  reflet::addReportCommand, reflet::addListCommand};
    return reflet::runProgram(argc, argv, commands);
}
