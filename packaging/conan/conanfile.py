"""Recipe of the library for Conan 2: conan create packaging/conan"""

import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir
from conan.tools.gnu import PkgConfigDeps


class RefletConan(ConanFile):
    name = "reflet"
    version = "0.2.0"
    license = "MIT"
    description = "Screen-space reflections, global illumination, ambient occlusion and soft shadows for Vulkan"
    topics = ("vulkan", "rendering", "ssr", "ssgi", "ambient-occlusion")
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True, "spirv-cross/*:shared": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, os.pardir, os.pardir)
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("reflet is tried on Linux alone")

    def requirements(self):
        # Used at build time; nothing of them is in the header.
        for reference in ("fmt/10.2.1", "glm/1.0.1", "nlohmann_json/3.11.3", "spirv-cross/1.3.268.0"):
            self.requires(reference, visible=False)
        self.requires("vulkan-headers/1.3.268.0", transitive_headers=True)
        self.requires("vulkan-loader/1.3.268.0")

    def build_requirements(self):
        self.tool_requires("shaderc/2024.1")  # glslc
        self.tool_requires("pkgconf/2.2.0")

    def generate(self):
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for option in ("REFLET_PROGRAM", "REFLET_TESTS", "REFLET_WERROR"):
            toolchain.cache_variables[option] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        for folder in ("cmake", "pkgconfig"):
            rmdir(self, os.path.join(self.package_folder, "lib", folder))

    def package_info(self):
        self.cpp_info.libs = ["reflet"]
        self.cpp_info.set_property("cmake_file_name", "reflet")
        self.cpp_info.set_property("cmake_target_name", "reflet::reflet")
        self.cpp_info.set_property("pkg_config_name", "reflet")
        if not self.options.shared:
            self.cpp_info.defines = ["REFLET_STATIC"]
            self.cpp_info.system_libs = ["stdc++", "m", "dl", "pthread"]
