// `reflet view`.
#pragma once

#include <CLI/CLI.hpp>

namespace reflet {

void addViewCommand(CLI::App& app);

}  // namespace reflet
