# Linux, built by Zig. The environment names the program and its target, such as x86_64-linux-musl.
set(CMAKE_SYSTEM_NAME Linux)
string(REGEX REPLACE "-.*" "" CMAKE_SYSTEM_PROCESSOR "$ENV{ZIG_TARGET}")
set(CMAKE_C_COMPILER "$ENV{ZIG}" cc)
set(CMAKE_C_COMPILER_TARGET "$ENV{ZIG_TARGET}")
