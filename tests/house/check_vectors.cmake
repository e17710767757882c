# Holds the compiler to the vectors that code promises: cmake -DCOMPILER=... -DEIGEN=... -P check_vectors.cmake, in the
# root of the repository.
set(source drivers/camera/depth_decoding.cpp)
# Decoding: two types, with and without neighbours in between, as depths and as disparities. Confidences: three types.
set(expected 11)

# The options of the release preset.
execute_process(COMMAND ${COMPILER} -std=c++20 -O3 -DNDEBUG -march=x86-64-v2 -fstack-protector-strong -fopt-info-vec -I.
                        -isystem ${EIGEN} -c ${source} -o /dev/null
                ERROR_VARIABLE told RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${source} does not compile:\n${told}")
endif()
string(REGEX MATCHALL "${source}:[^\n]*loop vectorized" loops "${told}")
list(LENGTH loops found)
if(found LESS expected)
  message(FATAL_ERROR "${source}: ${found} loops became vectors, not ${expected}:\n${told}")
endif()
message(STATUS "${source}: ${found} loops are vectors")
