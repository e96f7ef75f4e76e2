// `reflet list passes`.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds it to `reflet list`.
void addPassesList(CLI::App& list);

}  // namespace reflet
