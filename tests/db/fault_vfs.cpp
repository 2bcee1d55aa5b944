#include "tests/db/fault_vfs.hpp"

#include <sqlite3.h>

#include <cstring>
#include <mutex>
#include <new>

namespace pulseline::db::testing {
namespace {

using Call = FaultVfs::Call;
using Kind = FaultVfs::Kind;

struct {
    std::mutex mutex;
    FaultVfs::Plan plan;
    std::vector<Call> calls;
    std::int64_t faults = 0;
} g_state;

sqlite3_vfs* g_real = nullptr;

/// Whether this call goes wrong; every call counts.
bool fails(Call call, Kind& kind) {
    const std::lock_guard lock(g_state.mutex);
    g_state.calls.push_back(call);
    const auto number = static_cast<std::int64_t>(g_state.calls.size());
    const auto& plan = g_state.plan;
    kind = plan.kind;
    if (plan.at == 0 || number < plan.at || number >= plan.at + plan.calls) return false;
    // A full disk takes no new bytes; it can still be locked, synced and truncated.
    if (plan.kind != Kind::kIo && call != Call::kWrite) return false;
    ++g_state.faults;
    return true;
}
bool fails(Call call) {
    Kind kind;
    return fails(call, kind);
}

struct File {
    sqlite3_file base;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};
sqlite3_file* real(sqlite3_file* file) { return reinterpret_cast<File*>(file)->real(); }

int write_to(sqlite3_file* f, const void* data, int size, sqlite3_int64 offset) {
    Kind kind;
    if (!fails(Call::kWrite, kind)) return real(f)->pMethods->xWrite(real(f), data, size, offset);
    if (kind == Kind::kFull) return SQLITE_FULL;
    if (kind == Kind::kShortWrite) real(f)->pMethods->xWrite(real(f), data, size / 2, offset);
    return SQLITE_IOERR_WRITE;
}

const sqlite3_io_methods kMethods = {
    2,
    [](sqlite3_file* f) { return real(f)->pMethods->xClose(real(f)); },
    [](sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
        return real(f)->pMethods->xRead(real(f), to, size, at);
    },
    write_to,
    [](sqlite3_file* f, sqlite3_int64 size) {
        return fails(Call::kTruncate) ? SQLITE_IOERR_TRUNCATE
                                      : real(f)->pMethods->xTruncate(real(f), size);
    },
    // No test survives a power cut, so the disk is spared.
    [](sqlite3_file*, int) { return fails(Call::kSync) ? SQLITE_IOERR_FSYNC : SQLITE_OK; },
    [](sqlite3_file* f, sqlite3_int64* size) {
        return real(f)->pMethods->xFileSize(real(f), size);
    },
    [](sqlite3_file* f, int level) {
        return fails(Call::kLock) ? SQLITE_IOERR_LOCK : real(f)->pMethods->xLock(real(f), level);
    },
    [](sqlite3_file* f, int level) { return real(f)->pMethods->xUnlock(real(f), level); },
    [](sqlite3_file* f, int* held) { return real(f)->pMethods->xCheckReservedLock(real(f), held); },
    [](sqlite3_file* f, int op, void* arg) {
        return real(f)->pMethods->xFileControl(real(f), op, arg);
    },
    [](sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); },
    [](sqlite3_file* f) { return real(f)->pMethods->xDeviceCharacteristics(real(f)); },
    [](sqlite3_file* f, int page, int size, int extend, void volatile** to) {
        return fails(Call::kShared) ? SQLITE_IOERR_SHMMAP
                                    : real(f)->pMethods->xShmMap(real(f), page, size, extend, to);
    },
    [](sqlite3_file* f, int offset, int n, int flags) {
        // Giving a lock back never fails: SQLite does not look.
        if ((flags & SQLITE_SHM_UNLOCK) == 0 && fails(Call::kShared)) return SQLITE_IOERR_SHMLOCK;
        return real(f)->pMethods->xShmLock(real(f), offset, n, flags);
    },
    [](sqlite3_file* f) { real(f)->pMethods->xShmBarrier(real(f)); },
    [](sqlite3_file* f, int remove) { return real(f)->pMethods->xShmUnmap(real(f), remove); },
    nullptr,
    nullptr,
};

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* f, int flags, int* out) {
    f->pMethods = nullptr;
    if (fails(Call::kOpen)) return SQLITE_CANTOPEN;
    const int result = g_real->xOpen(g_real, name, real(f), flags, out);
    if (real(f)->pMethods) f->pMethods = &kMethods;
    return result;
}

}  // namespace

void FaultVfs::install() {
    static sqlite3_vfs vfs = [] {
        g_real = sqlite3_vfs_find(nullptr);
        sqlite3_vfs made = *g_real;
        made.zName = "pulseline-faults";
        made.pNext = nullptr;
        made.szOsFile = static_cast<int>(sizeof(File)) + g_real->szOsFile;
        made.xOpen = open_file;
        made.xDelete = [](sqlite3_vfs*, const char* name, int sync) {
            return fails(Call::kDelete) ? SQLITE_IOERR_DELETE : g_real->xDelete(g_real, name, sync);
        };
        return made;
    }();
    sqlite3_vfs_register(&vfs, 1);
}

void FaultVfs::begin(const Plan& plan) {
    const std::lock_guard lock(g_state.mutex);
    g_state.plan = plan;
    g_state.calls.clear();
    g_state.faults = 0;
}

void FaultVfs::heal() {
    const std::lock_guard lock(g_state.mutex);
    g_state.plan = {};
}

std::int64_t FaultVfs::faults() {
    const std::lock_guard lock(g_state.mutex);
    return g_state.faults;
}

std::vector<Call> FaultVfs::calls() {
    const std::lock_guard lock(g_state.mutex);
    return g_state.calls;
}

}  // namespace pulseline::db::testing
