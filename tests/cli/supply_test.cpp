// What is shipped: how the program and the library are hardened (packaging/hardened.sh), and the bill of materials
// (packaging/sbom.sh). Skipped where the tools are not installed, as elsewhere than on Debian.
#include "cli/program.h"

#include <regex>
#include <string>

namespace reflet::supply_test {
namespace {

constexpr const char* source = REFLET_SOURCE;

Arguments script(const char* name, const Arguments& more) {
    Arguments all{std::string(source) + "/packaging/" + name};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

class SupplyTest : public ProgramTest {
protected:
    static void need(std::initializer_list<const char*> programs) {
        for (const char* program : programs) {
            if (!isInstalled(program)) {
                GTEST_SKIP() << "no " << program << " in PATH";
            }
        }
    }
};

class Hardening : public SupplyTest {
protected:
    void SetUp() override { need({"bash", "readelf", "nm", "ar", "cc"}); }

    [[nodiscard]] Outcome check(const char* kind, const Arguments& files) const {
        Arguments all{kind};
        all.insert(all.end(), files.begin(), files.end());
        return runOther("bash", script("hardened.sh", all));
    }

    // A program of many functions, compiled with what everything has, and more.
    [[nodiscard]] Outcome checkCompiled(const char* kind, const Arguments& flags) const {
        std::string code = "#include <string.h>\n#include <stdio.h>\n";
        std::string calls;
        for (int i = 0; i < 30; ++i) {
            const std::string name = "f" + std::to_string(i);
            code += "int " + name + "(const char* s) { char b[16]; strcpy(b, s); return printf(\"%s\", b); }\n";
            calls += name + "(a[0]); ";
        }
        write("a.c", code + "int main(int n, char** a) { (void)n; " + calls + "return 0; }\n");
        Arguments all{"-O1",
                      "-U_FORTIFY_SOURCE",
                      "-D_FORTIFY_SOURCE=2",
                      "-fstack-protector-strong",
                      "-fcf-protection=full",
                      "-fPIE",
                      "-pie",
                      "-Wl,-z,relro,-z,now",
                      "a.c",
                      "-o",
                      "a"};
        all.insert(all.end(), flags.begin(), flags.end());
        const Outcome compiled = runOther("cc", all);
        EXPECT_EQ(compiled.status, 0) << compiled.err;
        return check(kind, {path("a").string()});
    }
};

TEST_F(Hardening, TheProgramAndTheLibraryAreHardened) {
#if defined REFLET_HARDENED_LINK
    const Outcome linked = check("linked", {REFLET_PROGRAM, REFLET_EXPORTS});
    EXPECT_EQ(linked.status, 0) << linked.err;
#if defined REFLET_HARDENED
    const std::string build = REFLET_BUILD;
    const Outcome full = check("full", {REFLET_PROGRAM, REFLET_EXPORTS, build + "/libreflet_scene.a",
                                        build + "/libreflet_base.a", build + "/libreflet_effects.a"});
    EXPECT_EQ(full.status, 0) << full.err;
#endif
#else
    GTEST_SKIP() << "builds with sanitizers, and on other systems than Linux, are not hardened";
#endif
}

TEST_F(Hardening, WhatIsMissingIsSaid) {
    if (runOther("cc", {"-dumpmachine"}).out.find("x86_64") == std::string::npos) {
        GTEST_SKIP() << "the flags are those of x86";
    }
    const Outcome all = checkCompiled("full", {});
    EXPECT_EQ(all.status, 0) << all.err;
    const auto says = [&](const char* kind, const Arguments& flags, const std::string& words) {
        const Outcome found = checkCompiled(kind, flags);
        return found.status == 1 && found.err.find(words) != std::string::npos;
    };
    EXPECT_TRUE(says("linked", {"-no-pie", "-fno-pie"}, "position independent"));
    EXPECT_TRUE(says("linked", {"-Wl,-z,norelro"}, "RELRO"));
    EXPECT_TRUE(says("linked", {"-Wl,-z,lazy"}, "BIND_NOW"));
    EXPECT_TRUE(says("linked", {"-Wl,-z,execstack"}, "executable stack"));
    EXPECT_TRUE(says("full", {"-fno-stack-protector"}, "stack protector"));
    EXPECT_TRUE(says("full", {"-U_FORTIFY_SOURCE"}, "fortified"));
    EXPECT_TRUE(says("full", {"-fcf-protection=none"}, "branch targets"));
    EXPECT_TRUE(says("full", {"-Wl,-rpath,/nowhere"}, "search path"));
}

// Makes packages of the built program and library, as cpack does.
constexpr const char* makePackages = R"sh(set -eu
mkdir -p work/debian packages
printf 'Source: reflet\n\nPackage: reflet\nArchitecture: any\n' >work/debian/control
pack() {  # name, file, place
    mkdir -p "work/$1/DEBIAN" "work/$1/$(dirname "$3")"
    strip -o "work/$1/$3" "$2"
    depends=$(cd work && dpkg-shlibdeps -O --ignore-missing-info -e"$1/$3" | sed 's/^shlibs:Depends=//')
    printf 'Package: %s\nVersion: 1.0-1\nArchitecture: %s\nMaintainer: nobody\nDescription: test\nDepends: %s\n' \
        "$1" "$(dpkg --print-architecture)" "$depends" >"work/$1/DEBIAN/control"
    dpkg-deb -Znone --root-owner-group -b "work/$1" packages
}
pack reflet "$1" usr/bin/reflet
pack libreflet0 "$2" usr/lib/libreflet.so.0)sh";

class Sbom : public SupplyTest {
protected:
    void SetUp() override {
        need({"bash", "python3", "dpkg-deb", "dpkg-shlibdeps", "readelf", "ldd", "ninja"});
        if (!IsSkipped() && !std::filesystem::exists(REFLET_BUILD "/.ninja_deps")) {
            GTEST_SKIP() << "the build folder is not ninja's";
        }
    }

    [[nodiscard]] Outcome check(const std::string& bill) const {
        write("bill.spdx", bill);
        return runOther("python3",
                        script("sbom_check.py", {path("bill.spdx").string(), path("packages").string(), REFLET_BUILD}));
    }
};

std::string without(const std::string& text, const std::string& expression) {
    return std::regex_replace(text, std::regex(expression), "");
}

TEST_F(Sbom, NamesWhatTheProgramAndTheLibraryAreMadeOf) {
    const Outcome made = runOther("bash", {"-c", makePackages, "bash", REFLET_PROGRAM, REFLET_EXPORTS});
    ASSERT_EQ(made.status, 0) << made.err;
    const Variables date{{"SOURCE_DATE_EPOCH", "1"}};
    const Outcome bill = runOther("bash", script("sbom.sh", {path("packages").string()}), date);
    ASSERT_EQ(bill.status, 0) << bill.err;
    const Outcome checked = check(bill.out);
    EXPECT_EQ(checked.status, 0) << checked.err;
    EXPECT_NE(bill.out.find("Created: 1970-01-01T00:00:01Z"), std::string::npos);
    EXPECT_EQ(runOther("bash", script("sbom.sh", {path("packages").string()}), date).out, bill.out);

    std::string less = bill.out + "Relationship: SPDXRef-reflet DEPENDS_ON SPDXRef-nothing\n";
    for (const char* line : {"Relationship: [^\n]* STATIC_LINK SPDXRef-libimgui-dev\n",
                             "Relationship: [^\n]* DEPENDS_ON SPDXRef-libzstd1\n", "PackageLicenseDeclared: MIT\n"}) {
        const std::string shorter = without(less, line);
        EXPECT_NE(shorter, less) << line;
        less = shorter;
    }
    const Outcome found = check(less);
    EXPECT_EQ(found.status, 1);
    for (const char* words : {"libimgui-dev", "libzstd.so", "has no PackageLicenseDeclared", "not there"}) {
        EXPECT_NE(found.err.find(words), std::string::npos) << words << ": " << found.err;
    }
}

}  // namespace
}  // namespace reflet::supply_test
