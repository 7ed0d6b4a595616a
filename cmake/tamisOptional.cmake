# What Tamis uses where it is there: xsimd for vector lanes, OpenMP for threads. TAMIS_USE_XSIMD and TAMIS_USE_OPENMP
# are AUTO (the default: use what is found), ON (it must be found) or OFF. The build and the installed package both read
# this file, so that the machine of the user decides, not the one that packaged Tamis.

# Sets `result` to AUTO, ON or OFF.
function(tamis_choice result option)
    if("${${option}}" STREQUAL "" OR "${${option}}" STREQUAL "AUTO")
        set(${result} AUTO PARENT_SCOPE)
    elseif(${option})
        set(${result} ON PARENT_SCOPE)
    else()
        set(${result} OFF PARENT_SCOPE)
    endif()
endfunction()

# Sets `result` to the folder of the headers of an installed xsimd that is new enough, or to nothing.
function(tamis_find_xsimd result)
    set(${result} "" PARENT_SCOPE)
    tamis_choice(wanted TAMIS_USE_XSIMD)
    if(wanted STREQUAL "OFF")
        return()
    endif()
    if(NOT TARGET xsimd)
        find_package(xsimd CONFIG QUIET)
    endif()
    # xsimd 7 has another interface.
    if(TARGET xsimd AND NOT (xsimd_VERSION AND xsimd_VERSION VERSION_LESS 8))
        get_target_property(folder xsimd INTERFACE_INCLUDE_DIRECTORIES)
        set(${result} "${folder}" PARENT_SCOPE)
    endif()
endfunction()

# Gives `target` the headers in `folder`. When that is empty Tamis's headers look for themselves, unless they must not.
# The target xsimd itself is not linked: Debian's asks for a library that need not be there.
function(tamis_add_xsimd target folder)
    tamis_choice(wanted TAMIS_USE_XSIMD)
    if(folder)
        target_include_directories(${target} SYSTEM INTERFACE $<BUILD_INTERFACE:${folder}>)
        target_compile_definitions(${target} INTERFACE $<BUILD_INTERFACE:TAMIS_XSIMD=1>)
    elseif(wanted STREQUAL "ON")
        message(FATAL_ERROR "TAMIS_USE_XSIMD is ON, but xsimd 8 or newer was not found. Install it, name its folder in "
                            "xsimd_DIR, or set TAMIS_USE_XSIMD to OFF.")
    elseif(wanted STREQUAL "OFF" OR TARGET xsimd)
        target_compile_definitions(${target} INTERFACE $<BUILD_INTERFACE:TAMIS_XSIMD=0>)
    endif()
endfunction()

# Links `target` with OpenMP when the compiler has it.
function(tamis_add_openmp target)
    tamis_choice(wanted TAMIS_USE_OPENMP)
    if(wanted STREQUAL "OFF")
        return()
    endif()
    find_package(OpenMP QUIET COMPONENTS CXX)
    if(TARGET OpenMP::OpenMP_CXX)
        target_link_libraries(${target} INTERFACE $<BUILD_INTERFACE:OpenMP::OpenMP_CXX>)
    elseif(wanted STREQUAL "ON")
        message(FATAL_ERROR "TAMIS_USE_OPENMP is ON, but the compiler ${CMAKE_CXX_COMPILER} was found to have no "
                            "OpenMP. Install its OpenMP library, or set TAMIS_USE_OPENMP to OFF.")
    endif()
endfunction()
