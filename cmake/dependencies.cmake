# The libraries Tamis and its own programs need: taken from the system, or else fetched in the versions named here.
include(FetchContent)

# Declares a header-only library as an imported target, so that its headers are system headers.
function(tamis_fetch_headers target name repository tag include_dir)
    message(STATUS "tamis: ${name} ${tag} is fetched, because it is not installed")
    # A folder without CMakeLists.txt: the library's own build is not wanted, only its headers.
    FetchContent_Declare(${name} GIT_REPOSITORY ${repository} GIT_TAG ${tag} GIT_SHALLOW ON SOURCE_SUBDIR headers_only)
    FetchContent_MakeAvailable(${name})
    FetchContent_GetProperties(${name} SOURCE_DIR source_dir)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} INTERFACE ${source_dir}/${include_dir})
endfunction()

# Declares a compiled library, and makes the headers of its targets system headers.
function(tamis_fetch_library name repository tag)
    message(STATUS "tamis: ${name} ${tag} is fetched, because it is not installed")
    FetchContent_Declare(${name} GIT_REPOSITORY ${repository} GIT_TAG ${tag} GIT_SHALLOW ON)
    FetchContent_MakeAvailable(${name})
    foreach(target ${ARGN})
        get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
        set_target_properties(${target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${directories}")
    endforeach()
endfunction()

function(tamis_need_eigen)
    if(NOT TARGET Eigen3::Eigen)
        find_package(Eigen3 CONFIG QUIET)
    endif()
    if(NOT TARGET Eigen3::Eigen)
        tamis_fetch_headers(Eigen3::Eigen Eigen https://gitlab.com/libeigen/eigen.git 3.4.0 .)
    elseif(DEFINED Eigen3_VERSION AND Eigen3_VERSION VERSION_LESS 3.4)
        message(FATAL_ERROR "tamis needs Eigen 3.4 or newer, and found ${Eigen3_VERSION} in ${Eigen3_DIR}. Install a "
                            "newer one, or set CMAKE_DISABLE_FIND_PACKAGE_Eigen3 to have 3.4.0 fetched.")
    endif()
endfunction()

# Sets `major` to 2 or 3. Catch2 3 brings a compiled main in Catch2::Catch2WithMain; for Catch2 2 the tests compile one.
function(tamis_need_catch2 major)
    find_package(Catch2 CONFIG QUIET)
    if(NOT Catch2_FOUND)
        tamis_fetch_library(Catch2 https://github.com/catchorg/Catch2.git v3.5.2 Catch2 Catch2WithMain)
        set(${major} 3 PARENT_SCOPE)
    elseif(Catch2_VERSION VERSION_LESS 3)
        set(${major} 2 PARENT_SCOPE)
    else()
        set(${major} 3 PARENT_SCOPE)
    endif()
endfunction()

function(tamis_need_benchmark)
    find_package(benchmark CONFIG QUIET)
    if(NOT benchmark_FOUND)
        foreach(option TESTING GTEST_TESTS INSTALL WERROR)
            set(BENCHMARK_ENABLE_${option} OFF CACHE BOOL "" FORCE)
        endforeach()
        tamis_fetch_library(benchmark https://github.com/google/benchmark.git v1.8.3 benchmark benchmark_main)
    endif()
endfunction()

function(tamis_need_cli11)
    find_package(CLI11 CONFIG QUIET)
    if(NOT TARGET CLI11::CLI11)
        tamis_fetch_headers(CLI11::CLI11 CLI11 https://github.com/CLIUtils/CLI11.git v2.4.1 include)
    endif()
endfunction()

function(tamis_need_json)
    find_package(nlohmann_json CONFIG QUIET)
    if(NOT TARGET nlohmann_json::nlohmann_json)
        tamis_fetch_headers(nlohmann_json::nlohmann_json json https://github.com/nlohmann/json.git v3.11.3
                            single_include)
    endif()
endfunction()
