/* Loaded before the C library (LD_PRELOAD): counts the calls by which a program changes the file system, and lets one of them fail.

   FAULT_KIND    full (no space left), error (input/output error), short (half of what was to be written), kill (the process ends before it),
                 states (nothing fails: what a kill before the call would leave is copied)
   FAULT_AT      the number of the call, from 1; the first one whose state is copied
   FAULT_ALL     if set, calls that remove, lock and exchange count too
   FAULT_STEP    from one state to the next
   FAULT_OF      the folder whose states are copied, into folders with the number of the call as their name in
   FAULT_STATES  this folder
   FAULT_CPU     the only processor of the program: then its calls come in one order

   Says "FAULT" on standard error when it strikes. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

enum outcome { GOES_ON, FAILS, IS_SHORT };

static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
static const char *kind;
static int calls, at, all, step = 1;

/* Copies what a kill at this moment would leave. */
static void copy(void)
{
    char into[4096];
    snprintf(into, sizeof into, "%s/%d", getenv("FAULT_STATES"), calls);
    char *words[] = {"cp", "-a", getenv("FAULT_OF"), into, NULL};
    char *environment[] = {"PATH=/usr/bin:/bin", NULL}; /* without this library */
    pid_t child;
    int status = 1;
    if (posix_spawnp(&child, "cp", NULL, NULL, words, environment) == 0) waitpid(child, &status, 0);
    if (status != 0) abort();
}

/* A call begins. Until its end no other one does. */
static enum outcome begin(void)
{
    if (!kind) return GOES_ON;
    pthread_mutex_lock(&one_at_a_time);
    calls++;
    if (!strcmp(kind, "states")) {
        if (calls >= at && (calls - at) % step == 0) copy();
        return GOES_ON;
    }
    if (calls != at) return GOES_ON;
    syscall(SYS_write, 2, "FAULT\n", 6);
    if (!strcmp(kind, "kill")) kill(getpid(), SIGKILL);
    return strcmp(kind, "short") ? FAILS : IS_SHORT;
}

static void end(void)
{
    if (kind) pthread_mutex_unlock(&one_at_a_time);
}

static int reason(void) { return strcmp(kind, "full") ? EIO : ENOSPC; }

static int fail(void)
{
    errno = reason();
    return -1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define CALL(type, real)                                       \
    do {                                                       \
        const type done = begin() == FAILS ? fail() : (real); \
        end();                                                 \
        return done;                                           \
    } while (0)

static int is_file(int fd)
{
    struct stat s;
    return fd > 2 && !fstat(fd, &s) && S_ISREG(s.st_mode);
}

ssize_t write(int fd, const void *bytes, size_t count)
{
    if (!is_file(fd)) return REAL(write)(fd, bytes, count);
    const enum outcome outcome = begin();
    const size_t now = outcome == IS_SHORT && count > 1 ? count / 2 : count;
    const ssize_t done = outcome == FAILS ? fail() : REAL(write)(fd, bytes, now);
    end();
    return done;
}

static int writes(const char *path, int flags)
{
    return (flags & (O_WRONLY | O_RDWR | O_CREAT)) && strncmp(path, "/dev/", 5) && strncmp(path, "/proc/", 6);
}

#define OPEN(name)                                                         \
    int name(const char *path, int flags, ...)                             \
    {                                                                      \
        va_list more;                                                      \
        va_start(more, flags);                                             \
        const mode_t mode = va_arg(more, mode_t);                          \
        va_end(more);                                                      \
        if (!writes(path, flags)) return REAL(name)(path, flags, mode);    \
        CALL(int, REAL(name)(path, flags, mode));                          \
    }
OPEN(open)
OPEN(open64)

int fsync(int fd) { CALL(int, REAL(fsync)(fd)); }

int rename(const char *from, const char *to) { CALL(int, REAL(rename)(from, to)); }

int mkdir(const char *path, mode_t mode) { CALL(int, REAL(mkdir)(path, mode)); }

int ftruncate64(int fd, off64_t size) { CALL(int, REAL(ftruncate64)(fd, size)); }

#define IF_ALL(name, arguments)                    \
    do {                                           \
        if (!all) return REAL(name) arguments;     \
        CALL(int, REAL(name) arguments);           \
    } while (0)

int unlink(const char *path) { IF_ALL(unlink, (path)); }

int rmdir(const char *path) { IF_ALL(rmdir, (path)); }

int flock(int fd, int operation) { IF_ALL(flock, (fd, operation)); }

/* renameat2 is called without the C library: the kernel hands it over as a signal, except with this sixth argument. */
#define OURS 0x6d6f7469

#if defined(__x86_64__)
#define ARGUMENTS(c) (c)->gregs[REG_RDI], (c)->gregs[REG_RSI], (c)->gregs[REG_RDX], (c)->gregs[REG_R10], (c)->gregs[REG_R8]
#define RESULT(c) (c)->gregs[REG_RAX]
#elif defined(__aarch64__)
#define ARGUMENTS(c) (c)->regs[0], (c)->regs[1], (c)->regs[2], (c)->regs[3], (c)->regs[4]
#define RESULT(c) (c)->regs[0]
#else
#error "the registers of system calls are not known here"
#endif

static void on_call(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)info;
    mcontext_t *registers = &((ucontext_t *)context)->uc_mcontext;
    const int before = errno;
    long done = -reason();
    if (begin() != FAILS) {
        done = syscall(SYS_renameat2, ARGUMENTS(registers), OURS);
        if (done < 0) done = -errno;
    }
    end();
    RESULT(registers) = done;
    errno = before;
}

static void hand_over_renameat2(void)
{
    struct sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[5])),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, OURS, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    struct sock_fprog program = {sizeof filter / sizeof *filter, filter};
    struct sigaction action = {.sa_sigaction = on_call, .sa_flags = SA_SIGINFO};
    if (sigaction(SIGSYS, &action, NULL) || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program))
        abort();
}

/* The number-th of the processors that the program may use, counted round. */
static void use_one_processor(int number)
{
    cpu_set_t may, one;
    CPU_ZERO(&one);
    if (sched_getaffinity(0, sizeof may, &may)) abort();
    number %= CPU_COUNT(&may);
    for (int cpu = 0; cpu < CPU_SETSIZE; cpu++)
        if (CPU_ISSET(cpu, &may) && number-- == 0) CPU_SET(cpu, &one);
    if (sched_setaffinity(0, sizeof one, &one)) abort();
}

__attribute__((constructor)) static void start(void)
{
    kind = getenv("FAULT_KIND");
    if (!kind) return;
    at = getenv("FAULT_AT") ? atoi(getenv("FAULT_AT")) : 0;
    if (getenv("FAULT_STEP")) step = atoi(getenv("FAULT_STEP"));
    if (getenv("FAULT_CPU")) use_one_processor(atoi(getenv("FAULT_CPU")));
    all = getenv("FAULT_ALL") != NULL;
    if (all) hand_over_renameat2();
}
