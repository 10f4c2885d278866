/* Loaded before the C library (LD_PRELOAD): counts the calls by which a program changes the file system, and lets one of them fail.

   FAULT_AT    the number of the call, from 1
   FAULT_KIND  full (no space left), error (input/output error), short (half of what was to be written), kill (the process ends before it)

   Says "FAULT" on standard error when it strikes. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int calls;

/* Whether this call is the one. */
static int struck(void)
{
    const char *at = getenv("FAULT_AT");
    if (!at || __sync_add_and_fetch(&calls, 1) != atoi(at)) return 0;
    syscall(SYS_write, 2, "FAULT\n", 6);
    if (!strcmp(getenv("FAULT_KIND"), "kill")) kill(getpid(), SIGKILL);
    return strcmp(getenv("FAULT_KIND"), "short") != 0;
}

static int fail(void)
{
    errno = strcmp(getenv("FAULT_KIND"), "full") ? EIO : ENOSPC;
    return -1;
}

static int is_file(int fd)
{
    struct stat s;
    return fd > 2 && !fstat(fd, &s) && S_ISREG(s.st_mode);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int fd, const void *bytes, size_t count)
{
    const int before = calls;
    if (is_file(fd) && struck()) return fail();
    const int is_short = calls != before && getenv("FAULT_AT") && calls == atoi(getenv("FAULT_AT")) && count > 1;
    return REAL(write)(fd, bytes, is_short ? count / 2 : count);
}

static int writes(const char *path, int flags)
{
    return (flags & (O_WRONLY | O_RDWR | O_CREAT)) && strncmp(path, "/dev/", 5) && strncmp(path, "/proc/", 6);
}

#define OPEN(name)                                                                     \
    int name(const char *path, int flags, ...)                                         \
    {                                                                                  \
        va_list more;                                                                  \
        va_start(more, flags);                                                         \
        const mode_t mode = va_arg(more, mode_t);                                      \
        va_end(more);                                                                  \
        return writes(path, flags) && struck() ? fail() : REAL(name)(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

int fsync(int fd) { return struck() ? fail() : REAL(fsync)(fd); }

int rename(const char *from, const char *to) { return struck() ? fail() : REAL(rename)(from, to); }

int mkdir(const char *path, mode_t mode) { return struck() ? fail() : REAL(mkdir)(path, mode); }

int ftruncate64(int fd, off64_t size) { return struck() ? fail() : REAL(ftruncate64)(fd, size); }
