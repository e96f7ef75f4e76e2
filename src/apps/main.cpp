// The program: subcommands in, exit status out. 0 done, 1 it failed, 2 wrong use.
#include "apps/commands.h"
#include "base/error.h"
#include "gpu/shader.h"

std::span<const reflet::gpu::EmbeddedShader> refletShaders();

namespace {

constexpr int exitFailed = 1;
constexpr int exitUsage = 2;

int complain(const char* message, int status) {
    fmt::print(stderr, "reflet: {}\n", message);
    return status;
}

int run(int argc, char** argv) {
    reflet::gpu::registerShaders(refletShaders());
    CLI::App app("Reflet: screen-space reflections, indirect light and shadows on any Vulkan device.", "reflet");
    app.set_version_flag("--version", std::string("reflet ") + REFLET_VERSION);
    app.require_subcommand(1);
    app.footer("Try: reflet render builtin:cubes -o cubes.png\nEach subcommand has its own --help.");
    reflet::addRenderCommand(app);
    reflet::addListCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return complain(fmt::format("{} (reflet --help says more)", error.what()).c_str(), exitUsage);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const reflet::UsageError& error) {
        return complain(error.what(), exitUsage);
    } catch (const std::exception& error) {
        return complain(error.what(), exitFailed);
    }
}
