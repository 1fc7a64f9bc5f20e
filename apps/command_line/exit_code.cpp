#include "exit_code.h"

#include "interruption.h"

#include <duskline/execution/progress.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/file_errors.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <string>

namespace duskline::cli {
namespace {

int fail(std::string_view program, ExitCode code, std::string text) noexcept
{
    // Libraries may pass on texts of several lines; an error is one line.
    std::ranges::replace(text, '\n', ' ');
    std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(program.size()), program.data(), text.c_str());
    return static_cast<int>(code);
}

} // namespace

int report_failure(std::string_view program) noexcept
{
    try {
        throw;
    } catch (const Cancelled&) {
        fail(program, ExitCode::failed, "interrupted; nothing was written");
        return exit_code_of_interruption();
    } catch (const UsageError& error) {
        return fail(program, ExitCode::usage, error.what());
    } catch (const InvalidInput& error) {
        return fail(program, ExitCode::usage, error.what());
    } catch (const StandardOutputError& error) {
        return fail(program, ExitCode::output, error.what());
    } catch (const InputError& error) {
        return fail(program, ExitCode::input, error.what());
    } catch (const OutputError& error) {
        return fail(program, ExitCode::output, error.what());
    } catch (const UnsupportedOnThisMachine& error) {
        return fail(program, ExitCode::resources, error.what());
    } catch (const std::bad_alloc&) {
        return fail(program, ExitCode::resources, "out of memory");
    } catch (const std::exception& error) {
        return fail(program, ExitCode::failed, error.what());
    } catch (...) {
        return fail(program, ExitCode::failed, "failed for an unknown reason");
    }
}

} // namespace duskline::cli
