# OpenMP, for threads: TAMIS_USE_OPENMP is AUTO (the default: use what is found), ON (it must be found) or OFF. The build
# and the installed package both read this file, so that the machine of the user decides, not the one that packaged Tamis.

# Links `target` with OpenMP when the compiler has it.
function(tamis_add_openmp target)
    set(is_auto OFF)
    if("${TAMIS_USE_OPENMP}" STREQUAL "" OR "${TAMIS_USE_OPENMP}" STREQUAL "AUTO")
        set(is_auto ON)
    elseif(NOT TAMIS_USE_OPENMP)
        return()
    endif()
    find_package(OpenMP QUIET COMPONENTS CXX)
    if(TARGET OpenMP::OpenMP_CXX)
        target_link_libraries(${target} INTERFACE $<BUILD_INTERFACE:OpenMP::OpenMP_CXX>)
    elseif(NOT is_auto)
        message(FATAL_ERROR "TAMIS_USE_OPENMP is ON, but the compiler ${CMAKE_CXX_COMPILER} was found to have no "
                            "OpenMP. Install its OpenMP library, or set TAMIS_USE_OPENMP to OFF.")
    endif()
endfunction()
