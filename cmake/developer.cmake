# How Tamis's own programs are compiled: tests, examples and benchmarks. Nothing here reaches a user of the library.
option(TAMIS_WERROR "Treat warnings as errors" OFF)
option(TAMIS_NATIVE "Compile for the processor of this machine" ON)
set(TAMIS_SANITIZE "" CACHE STRING "Sanitizer: empty, address (with undefined behaviour) or thread")
set_property(CACHE TAMIS_SANITIZE PROPERTY STRINGS "" address thread)

get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT multi_config)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(tamis_developer INTERFACE)
target_compile_options(tamis_developer INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
if(TAMIS_NATIVE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC's own AVX-512 header reads variables before they are set, and callers get the warning (GCC bug 105593).
    target_compile_options(tamis_developer INTERFACE -Wno-uninitialized -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # By default GCC collects garbage each time that its heap has doubled: with a gigabyte it compiles in nine tenths of
    # the time.
    target_compile_options(tamis_developer INTERFACE --param=ggc-min-heapsize=1000000)
endif()
if(TAMIS_WERROR)
    target_compile_options(tamis_developer INTERFACE -Werror)
endif()
if(TAMIS_NATIVE)
    target_compile_options(tamis_developer INTERFACE -march=native)
endif()
# g++ contracts a * b + c over statements as it is; clang needs to be told, or kernels lose a fifth of their speed.
target_compile_options(tamis_developer INTERFACE $<$<CXX_COMPILER_ID:Clang,AppleClang>:-ffp-contract=fast>)

if(TAMIS_SANITIZE STREQUAL "address")
    set(tamis_sanitize -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(TAMIS_SANITIZE STREQUAL "thread")
    set(tamis_sanitize -fsanitize=thread -fno-omit-frame-pointer)
elseif(NOT TAMIS_SANITIZE STREQUAL "")
    message(FATAL_ERROR "TAMIS_SANITIZE is \"${TAMIS_SANITIZE}\"; set it to address, to thread, or to nothing.")
endif()
target_compile_options(tamis_developer INTERFACE ${tamis_sanitize})
target_link_options(tamis_developer INTERFACE ${tamis_sanitize})

# tamis_program(<target> <source>...): an executable with the library and the settings above.
function(tamis_program target)
    add_executable(${target} ${ARGN})
    tamis_settings(${target})
endfunction()

# tamis_settings(<target>): the same for a target of another kind.
function(tamis_settings target)
    target_link_libraries(${target} PRIVATE tamis::tamis tamis_developer)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()
