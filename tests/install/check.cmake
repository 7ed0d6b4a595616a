# Installs the build in BUILD below FOLDER, then configures, builds and runs the project CONSUMER against that.
cmake_minimum_required(VERSION 3.22)

function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    message("${output}")
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "This command failed, with the output above:\n  ${command}")
    endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
set(options -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${FOLDER}/prefix)
if(VARIANT STREQUAL "eigen_alone")
    list(APPEND options -DCMAKE_CXX_FLAGS=-DTAMIS_VECTORS=0 -DTAMIS_USE_OPENMP=OFF -DEIGEN_ALONE=ON)
endif()
if(NOT EIGEN)
    # Eigen was fetched, not installed: the consumer is given the same headers as a package.
    set(EIGEN ${FOLDER}/eigen)
    file(WRITE ${EIGEN}/Eigen3Config.cmake "add_library(Eigen3::Eigen INTERFACE IMPORTED)\n"
         "target_include_directories(Eigen3::Eigen INTERFACE \"${EIGEN_INCLUDE}\")\n")
endif()
list(APPEND options -DEigen3_DIR=${EIGEN})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${FOLDER}/build -G ${GENERATOR} ${options})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/bar)
