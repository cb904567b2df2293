/* ST's NUCLEO-H753ZI: clocks, USART3 at the ST-LINK's virtual COM port, cycle counter and watchdog. Numbers of chapters
 * are those of RM0433. */
#include "../board.h"

#include "../processor.h"

const uint32_t board_clock_hz = 400000000;

enum { BAUD = 1000000, USART_CLOCK_HZ = 100000000 };

/* Flash (4.9) */
#define FLASH_ACR REGISTER(0x52002000U)
#define FLASH_ACR_AT_200_MHZ ((2U << 4) | 2U) /* signal delay, wait states: at most 210 MHz in range VOS1 */

/* Power (6.8) */
#define PWR_CSR1 REGISTER(0x58024804U)
#define PWR_CSR1_ACTVOSRDY (1U << 13)
#define PWR_CR3 REGISTER(0x5802480CU)
#define PWR_CR3_SUPPLY 7U
#define PWR_CR3_LDO 6U /* the write locks the choice, also if it is that after a reset */
#define PWR_D3CR REGISTER(0x58024818U)
#define PWR_D3CR_VOS1 (3U << 14)
#define PWR_D3CR_VOSRDY (1U << 13)

/* Reset and clocks (8.7) */
#define RCC_CR REGISTER(0x58024400U)
#define RCC_CR_HSEON (1U << 16)
#define RCC_CR_HSERDY (1U << 17)
#define RCC_CR_HSEBYP (1U << 18) /* the ST-LINK supplies a clock, and there is no crystal */
#define RCC_CR_PLL1ON (1U << 24)
#define RCC_CR_PLL1RDY (1U << 25)
#define RCC_CFGR REGISTER(0x58024410U)
#define RCC_CFGR_SW 7U
#define RCC_CFGR_SW_PLL1 3U
#define RCC_CFGR_SWS (7U << 3)
#define RCC_CFGR_SWS_PLL1 (3U << 3)
#define RCC_D1CFGR REGISTER(0x58024418U)
#define RCC_D1CFGR_HALF ((4U << 4) | 8U) /* D1PPRE, HPRE: 2 */
#define RCC_D2CFGR REGISTER(0x5802441CU)
#define RCC_D2CFGR_HALF ((4U << 8) | (4U << 4)) /* D2PPRE2, D2PPRE1: 2 */
#define RCC_D3CFGR REGISTER(0x58024420U)
#define RCC_D3CFGR_HALF (4U << 4) /* D3PPRE: 2 */
#define RCC_PLLCKSELR REGISTER(0x58024428U)
#define RCC_PLLCKSELR_HSE_BY_1 ((1U << 4) | 2U) /* DIVM1, PLLSRC */
#define RCC_PLLCFGR REGISTER(0x5802442CU)
#define RCC_PLLCFGR_P ((1U << 16) | (3U << 2)) /* DIVP1EN; PLL1RGE: 8 to 16 MHz in; wide VCO */
#define RCC_PLL1DIVR REGISTER(0x58024430U)
#define RCC_PLL1DIVR_100_BY_2 ((1U << 9) | 99U) /* DIVP1, DIVN1: each plus one */
#define RCC_RSR REGISTER(0x580244D0U)
#define RCC_RSR_RMVF (1U << 16)
#define RCC_RSR_IWDG1RSTF (1U << 26)
#define RCC_AHB4ENR REGISTER(0x580244E0U)
#define RCC_AHB4ENR_GPIOD (1U << 3)
#define RCC_APB1LENR REGISTER(0x580244E8U)
#define RCC_APB1LENR_USART3 (1U << 18)

/* Pins (11.4): PD8 is the transmitter of USART3, alternate function 7 */
#define GPIOD_MODER REGISTER(0x58020C00U)
#define GPIOD_AFRH REGISTER(0x58020C24U)

/* Serial line (48.7) */
#define USART3_CR1 REGISTER(0x40004800U)
#define USART3_CR1_RUN ((1U << 29) | (1U << 3) | 1U) /* FIFO, transmitter, enable */
#define USART3_BRR REGISTER(0x4000480CU)
#define USART3_ISR REGISTER(0x4000481CU)
#define USART3_ISR_TXFNF (1U << 7) /* the FIFO is not full */
#define USART3_TDR REGISTER(0x40004828U)

/* Watchdog (45.4), and its stop by a debugger (60.5) */
#define IWDG1_KR REGISTER(0x58004800U)
#define IWDG1_KR_START 0xCCCCU
#define IWDG1_KR_UNLOCK 0x5555U
#define IWDG1_KR_FEED 0xAAAAU
#define IWDG1_PR REGISTER(0x58004804U)
#define IWDG1_PR_BY_4 0U
#define IWDG1_RLR REGISTER(0x58004808U)
#define IWDG1_SR REGISTER(0x5800480CU)
#define DBGMCU_APB4FZ1 REGISTER(0x5C001054U)
#define DBGMCU_APB4FZ1_IWDG1 (1U << 18)

static bool was_reset_by_watchdog;

static void wait_for(volatile const uint32_t *address, uint32_t mask, uint32_t value)
{
    while ((*address & mask) != value) {
    }
}

/* 400 MHz for the processor, 200 MHz for the buses, 100 MHz for the UART, all from the 8 MHz of the ST-LINK. */
static void start_clocks(void)
{
    PWR_CR3 = (PWR_CR3 & ~PWR_CR3_SUPPLY) | PWR_CR3_LDO;
    wait_for(&PWR_CSR1, PWR_CSR1_ACTVOSRDY, PWR_CSR1_ACTVOSRDY);
    PWR_D3CR |= PWR_D3CR_VOS1;
    wait_for(&PWR_D3CR, PWR_D3CR_VOSRDY, PWR_D3CR_VOSRDY);

    RCC_CR |= RCC_CR_HSEBYP;
    RCC_CR |= RCC_CR_HSEON;
    wait_for(&RCC_CR, RCC_CR_HSERDY, RCC_CR_HSERDY);
    RCC_PLLCKSELR = RCC_PLLCKSELR_HSE_BY_1;
    RCC_PLLCFGR = RCC_PLLCFGR_P;
    RCC_PLL1DIVR = RCC_PLL1DIVR_100_BY_2;
    RCC_CR |= RCC_CR_PLL1ON;
    wait_for(&RCC_CR, RCC_CR_PLL1RDY, RCC_CR_PLL1RDY);

    FLASH_ACR = FLASH_ACR_AT_200_MHZ;
    wait_for(&FLASH_ACR, FLASH_ACR_AT_200_MHZ, FLASH_ACR_AT_200_MHZ);
    RCC_D1CFGR = RCC_D1CFGR_HALF;
    RCC_D2CFGR = RCC_D2CFGR_HALF;
    RCC_D3CFGR = RCC_D3CFGR_HALF;
    RCC_CFGR = (RCC_CFGR & ~RCC_CFGR_SW) | RCC_CFGR_SW_PLL1;
    wait_for(&RCC_CFGR, RCC_CFGR_SWS, RCC_CFGR_SWS_PLL1);
}

static void start_line(void)
{
    RCC_AHB4ENR |= RCC_AHB4ENR_GPIOD;
    RCC_APB1LENR |= RCC_APB1LENR_USART3;
    (void)RCC_APB1LENR; /* the peripherals have their clocks after this (8.5.10) */
    GPIOD_AFRH = (GPIOD_AFRH & ~0xFU) | 7U;
    GPIOD_MODER = (GPIOD_MODER & ~(3U << 16)) | (2U << 16);
    USART3_BRR = USART_CLOCK_HZ / BAUD;
    USART3_CR1 = USART3_CR1_RUN;
}

void board_start(void)
{
    SCB_ICIALLU = 0;
    processor_barrier();
    SCB_CCR |= SCB_CCR_IC;
    processor_barrier();
    was_reset_by_watchdog = (RCC_RSR & RCC_RSR_IWDG1RSTF) != 0U;
    RCC_RSR |= RCC_RSR_RMVF;
    start_clocks();
    start_line();
    DCB_DEMCR |= DCB_DEMCR_TRCENA;
    DWT_LAR = DWT_LAR_KEY;
    DWT_CYCCNT = 0;
    DWT_CTRL |= DWT_CTRL_CYCCNTENA;
}

uint32_t board_cycles(void)
{
    return DWT_CYCCNT;
}

bool board_send(char byte)
{
    const bool has_room = (USART3_ISR & USART3_ISR_TXFNF) != 0U;

    if (has_room) {
        USART3_TDR = (uint8_t)byte;
    }
    return has_room;
}

void board_start_watchdog(void)
{
    DBGMCU_APB4FZ1 |= DBGMCU_APB4FZ1_IWDG1;
    IWDG1_KR = IWDG1_KR_START;
    IWDG1_KR = IWDG1_KR_UNLOCK;
    IWDG1_PR = IWDG1_PR_BY_4;
    IWDG1_RLR = 800; /* at 8 kHz, a quarter of the slow oscillator's clock */
    wait_for(&IWDG1_SR, UINT32_MAX, 0);
    IWDG1_KR = IWDG1_KR_FEED;
}

void board_feed_watchdog(void)
{
    IWDG1_KR = IWDG1_KR_FEED;
}

bool board_was_reset_by_watchdog(void)
{
    return was_reset_by_watchdog;
}
