// `reflet man`, `reflet completion`: from CLI11's tables of options, so that they cannot differ from the program.
#include "cli/manual.h"

#include "base/error.h"
#include "capture/show.h"
#include "renderer/presets.h"
#include "scene/builtin.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace reflet {

namespace {

using Names = std::vector<std::string>;

std::vector<const CLI::App*> subcommandsOf(const CLI::App& app) {
    const auto all = app.get_subcommands([](const CLI::App*) { return true; });
    return {all.begin(), all.end()};
}

std::vector<const CLI::Option*> namedOptions(const CLI::App& app) {
    std::vector<const CLI::Option*> named;
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_positional()) {
            named.push_back(option);
        }
    }
    return named;
}

Names spellings(const CLI::Option& option) {
    Names names;
    std::ranges::transform(option.get_snames(), std::back_inserter(names), [](const auto& n) { return "-" + n; });
    std::ranges::transform(option.get_lnames(), std::back_inserter(names), [](const auto& n) { return "--" + n; });
    return names;
}

// What completes an option's value, by the word that the help has for it.
Names valuesOf(const CLI::Option& option) {
    Names values;
    const auto is = [&](const char* name) { return option.check_lname(name); };
    if (is("preset") || is("compare")) {
        std::ranges::transform(presets(), std::back_inserter(values), &Preset::name);
    } else if (is("show") || is("aov") || is("layer")) {
        std::ranges::transform(shows(), std::back_inserter(values), [](const Show& s) { return std::string(s.name); });
    } else if (is("set")) {
        std::ranges::transform(settingEntries(), std::back_inserter(values),
                               [](const SettingEntry& e) { return e.name + "="; });
    }
    return values;
}

Names sceneNames() {
    Names names;
    for (const BuiltinScene& scene : builtinScenes()) {
        names.push_back(fmt::format("builtin:{}", scene.name));
    }
    return names;
}

bool takesScene(const CLI::App& command) {
    return std::ranges::any_of(command.get_options(),
                               [](const CLI::Option* o) { return o->get_positional() && o->check_name("SCENE"); });
}

// A line that begins with a dot or a quote would be a request to troff.
std::string troff(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool first = result.empty() || result.back() == '\n';
        if (first && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return result;
}

std::string optionItem(const CLI::Option& option) {
    std::string names =
        option.get_positional() ? option.get_name(true) : fmt::format("{}", fmt::join(spellings(option), ", "));
    if (!option.get_positional() && option.get_items_expected_max() > 0) {
        names += " " + option.get_type_name();
    }
    return fmt::format(".TP\n.B {}\n{}\n", troff(names), troff(option.get_description()));
}

std::string commandSection(const CLI::App& command, const std::string& name) {
    std::string text = fmt::format(".SS {}\n{}\n", troff(name), troff(command.get_description()));
    for (const CLI::Option* option : command.get_options()) {
        text += optionItem(*option);
    }
    if (!command.get_footer().empty()) {
        text += fmt::format(".PP\n.nf\n{}\n.fi\n", troff(command.get_footer()));
    }
    for (const CLI::App* sub : subcommandsOf(command)) {
        text += commandSection(*sub, name + " " + sub->get_name());
    }
    return text;
}

std::string shellCase(const CLI::App& command) {
    Names words;
    std::string values;
    for (const CLI::Option* option : namedOptions(command)) {
        const Names names = spellings(*option);
        words.insert(words.end(), names.begin(), names.end());
        if (const Names known = valuesOf(*option); !known.empty()) {
            values += fmt::format("        {}) words=\"{}\" ;;\n", fmt::join(names, "|"), fmt::join(known, " "));
        } else if (option->get_items_expected_max() > 0) {
            values += fmt::format("        {}) files=1 ;;\n", fmt::join(names, "|"));
        }
    }
    for (const CLI::App* sub : subcommandsOf(command)) {
        words.push_back(sub->get_name());
    }
    if (takesScene(command)) {
        const Names scenes = sceneNames();
        words.insert(words.end(), scenes.begin(), scenes.end());
    }
    return fmt::format("    {})\n        case $before in\n{}        *) words=\"{}\" files=1 ;;\n        esac ;;\n",
                       command.get_name(), values, fmt::join(words, " "));
}

std::string bashCompletion(const CLI::App& app) {
    Names commands;
    std::string cases;
    for (const CLI::App* command : subcommandsOf(app)) {
        commands.push_back(command->get_name());
        cases += shellCase(*command);
    }
    return fmt::format(
        R"(# Completion of reflet. bash: put it into ~/.local/share/bash-completion/completions/reflet
_reflet() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words="" files=""
    # bash splits words at colons and equal signs, too.
    if [[ $COMP_CWORD -ge 2 && $word == ":" ]]; then word=$before:; fi
    if [[ $COMP_CWORD -ge 3 && $before == ":" ]]; then word=${{COMP_WORDS[COMP_CWORD-2]}}:$word; fi
    if [[ $COMP_CWORD -eq 1 ]]; then
        words="{} --help --version"
    else
        case ${{COMP_WORDS[1]}} in
{}        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    if [[ -n $files ]]; then COMPREPLY+=($(compgen -f -- "$word")); fi
    case $word in
    *:*) COMPREPLY=("${{COMPREPLY[@]#"${{word%"${{word##*:}}"}}"}}") ;;
    esac
    case ${{COMPREPLY[0]-}} in
    *=) compopt -o nospace 2>/dev/null ;;
    esac
}}
complete -o filenames -F _reflet reflet
)",
        fmt::join(commands, " "), cases);
}

std::string fishWord(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        quoted += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return quoted + "'";
}

std::string fishCompletion(const CLI::App& app) {
    std::string text = "# Completion of reflet. Put it into ~/.config/fish/completions/reflet.fish\n";
    for (const CLI::App* command : subcommandsOf(app)) {
        const std::string within =
            fmt::format("complete -c reflet -n '__fish_seen_subcommand_from {}'", command->get_name());
        text += fmt::format("complete -c reflet -n __fish_use_subcommand -a {} -d {}\n", command->get_name(),
                            fishWord(command->get_description()));
        for (const CLI::Option* option : namedOptions(*command)) {
            text += within;
            for (const std::string& name : option->get_lnames()) {
                text += " -l " + name;
            }
            for (const std::string& name : option->get_snames()) {
                text += " -s " + name;
            }
            if (option->get_items_expected_max() > 0) {
                text += " -r";
            }
            if (const Names values = valuesOf(*option); !values.empty()) {
                text += fmt::format(" -f -a '{}'", fmt::join(values, " "));
            }
            text += fmt::format(" -d {}\n", fishWord(option->get_description()));
        }
        if (takesScene(*command)) {
            text += fmt::format("{} -a '{}'\n", within, fmt::join(sceneNames(), " "));
        }
        for (const CLI::App* sub : subcommandsOf(*command)) {
            text += fmt::format("{} -f -a {} -d {}\n", within, sub->get_name(), fishWord(sub->get_description()));
        }
    }
    return text;
}

}  // namespace

std::string manualPage(const CLI::App& app, std::string_view version) {
    std::string text = fmt::format(
        ".TH REFLET 1 \"\" \"reflet {}\"\n.SH NAME\nreflet \\- {}\n.SH SYNOPSIS\n.B reflet\n.I COMMAND\n[OPTION]...\n"
        ".SH COMMANDS\n",
        version, troff(app.get_description()));
    for (const CLI::App* command : subcommandsOf(app)) {
        text += commandSection(*command, "reflet " + command->get_name());
    }
    return text +
           ".SH EXIT STATUS\n0 done, 1 something failed (the message on standard error says what, where and what to "
           "do), 2 the command line is wrong.\n";
}

std::string shellCompletion(const CLI::App& app, std::string_view shell) {
    if (shell == "fish") {
        return fishCompletion(app);
    }
    const std::string bash = bashCompletion(app);
    return shell == "zsh" ? "#compdef reflet\nautoload -U +X bashcompinit && bashcompinit\n" + bash : bash;
}

void addManualCommands(CLI::App& app, std::string_view version) {
    CLI::App* man = app.add_subcommand("man", "Print the manual page, in troff: reflet man | man -l -");
    man->callback([&app, version] { fmt::print("{}", manualPage(app, version)); });
    auto shell = std::make_shared<std::string>();
    CLI::App* completion = app.add_subcommand("completion", "Print completion for a shell");
    completion->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    completion->footer("bash, for this session: source <(reflet completion bash)");
    completion->callback([&app, shell] { fmt::print("{}", shellCompletion(app, *shell)); });
}

}  // namespace reflet
