// `reflet view`.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

void addViewCommand(CLI::App& app);

}  // namespace reflet
