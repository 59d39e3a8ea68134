/* The files that `boresight new` writes, as bytes. Each ends with a zero byte. */
        .section .rodata
        .macro template name, file
        .global boresight_template_\name
boresight_template_\name:
        .incbin "\file"
        .byte 0
        .endm
        template mechanism, TEMPLATE_MECHANISM
        template montecarlo, TEMPLATE_MONTECARLO
        template sweep, TEMPLATE_SWEEP
        template sensitivity, TEMPLATE_SENSITIVITY
        template match, TEMPLATE_MATCH
        template allocate, TEMPLATE_ALLOCATE
        template budget, TEMPLATE_BUDGET
        template calibrate, TEMPLATE_CALIBRATE
        .section .note.GNU-stack,"",%progbits
