#include "firmware_app/command_line.hpp"

int main(int argument_count, char** arguments) { return graspd::run_command_line(argument_count, arguments); }
