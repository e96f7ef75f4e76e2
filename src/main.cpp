// Entry point: names the subcommands.
#include "apps/commands.h"
#include "apps/program.h"
#include "view/view_command.h"

int main(int argc, char** argv) {
    constexpr reflet::AddCommand commands[] = {
        reflet::addRenderCommand, reflet::addViewCommand,   reflet::addReferenceCommand, reflet::addCompareCommand,
        reflet::addBenchCommand,  reflet::addReportCommand, reflet::addListCommand};
    return reflet::runProgram(argc, argv, commands);
}
